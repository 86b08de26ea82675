/* boxes: what a class is, its cells, and where it is over each of them, read from the bytes of an atlas. */
#include "box.h"
#include "chart.h"
#include "read.h"

#include <string.h>

static bool is_side(const cage_atlas *atlas, int32_t side)
{
    return atlas && (side == CAGE_SIDE_INNER || side == CAGE_SIDE_OUTER) && (atlas->side & side);
}

int32_t cage_atlas_class(const cage_atlas *atlas, int32_t side, int32_t class_number, cage_class *out)
{
    if (!is_side(atlas, side) || !out || class_number < 0 || class_number >= atlas->classes[side == CAGE_SIDE_OUTER])
        return CAGE_ERROR_ARGUMENT;
    uint32_t at = cage_read_side(atlas, side == CAGE_SIDE_OUTER, CAGE_SIDE_TABLE) + (uint32_t)class_number * CAGE_CLASS_WORDS;
    uint32_t leaf = cage_read_word(atlas, at + CAGE_CLASS_LEAF);
    struct cage_cell cell;
    cage_class made = {cage_read_number(atlas, at + CAGE_CLASS_CELLS), cage_read_number(atlas, at + CAGE_CLASS_NODES),
                       {0, 0, 0}, {0, 0, 0}, {0, 0, 0, 0}, cage_read_number(atlas, at + CAGE_CLASS_SINE),
                       0, {{0, 0, 0}, {1, 0, 0, 0}}};
    for (uint32_t k = 0; k < 3; k++) {
        made.low[k] = cage_read_number(atlas, at + CAGE_CLASS_LOW + k);
        made.high[k] = cage_read_number(atlas, at + CAGE_CLASS_HIGH + k);
        made.pose.x[k] = cage_read_number(atlas, at + CAGE_CLASS_AT + k);
    }
    for (uint32_t k = 0; k < 4; k++)
        made.q[k] = cage_read_number(atlas, at + CAGE_CLASS_Q + k);
    made.known = leaf > 0 && leaf <= (uint32_t)atlas->leaves && cage_read_cell(atlas, leaf - 1, &cell);
    if (made.known)
        cage_read_fibre(atlas)->representative(&cell, made.pose.q);
    *out = made;
    return CAGE_OK;
}

int32_t cage_atlas_cell(const cage_atlas *atlas, int32_t cell, int32_t q[4], int32_t corner[8][4])
{
    struct cage_cell made;
    if (!atlas || !q || !corner || cell < 0 || cell >= atlas->leaves || !cage_read_cell(atlas, (uint32_t)cell, &made))
        return CAGE_ERROR_ARGUMENT;
    cage_read_fibre(atlas)->representative(&made, q);
    return cage_read_fibre(atlas)->corners(&made, corner);
}

/* ---- boxes of a class ------------------------------------------------------------------------------------ */

enum { BOXES_DEEPEST = 32, MOST_HALVINGS = 20 };

/* A box that was halved: whether by the chart, and what is to be done. */
struct box_frame {
    int32_t low[3];
    int32_t bits;   /* of its size */
    uint32_t entry; /* of the chart: where its halves' entries begin, or the list that holds for all of them */
    bool listed;
    uint32_t left;  /* halves to do */
    uint32_t met[(CAGE_CHART_BALLS_3D + 31) / 32]; /* of the list's balls, bit by bit, those that meet it */
};

struct visitor {
    const cage_atlas *atlas;
    uint32_t chart;
    uint32_t node;   /* the first of the cell */
    uint32_t of;     /* where the classes of nodes begin */
    uint32_t class;
    int32_t least;   /* bits of the smallest boxes that are halved for their lists */
    int32_t low[3], high[3]; /* beyond that box there is nothing of it */
    cage_visit *visit;
    void *context;
    int64_t count;
    int32_t splits;  /* of the chart, which has no more than the atlas has words */
};

static bool is_in(const struct visitor *v, int32_t component)
{
    return component >= 0 && cage_read_word(v->atlas, v->of + v->node + (uint32_t)component) == v->class;
}

/* May some of the list's components be of the class? */
static bool may_hold(const struct visitor *v, uint32_t list)
{
    const uint32_t size = (uint32_t)v->atlas->dim + 2;
    uint32_t balls = cage_read_word(v->atlas, list) & 65535, simplices = cage_read_word(v->atlas, list) >> 16;
    bool may = is_in(v, cage_read_number(v->atlas, list + 1));
    for (uint32_t i = 0; i < simplices && !may; i++)
        may = is_in(v, cage_read_number(v->atlas, list + 2 + balls + size * i));
    return may;
}

enum { NOTHING, PART, WHOLE };

/* How much of the box belongs to the class: looks at the balls that may meet it, and leaves those that do. Where none does,
 * all of it lies in one component. */
static int32_t share_of(const struct visitor *v, struct box_frame *f, const cage_atlas_box *at)
{
    uint32_t balls = cage_read_word(v->atlas, f->entry) & 65535;
    const struct cage_box box = {{at->low[0], at->low[1], at->low[2]}, {at->high[0], at->high[1], at->high[2]}};
    bool met = false;
    for (uint32_t i = 0; i < balls && i < CAGE_CHART_BALLS_3D; i++) {
        if (!(f->met[i / 32] >> i % 32 & 1))
            continue;
        const cage_ball ball = cage_read_ball(v->atlas, v->chart + cage_read_word(v->atlas, f->entry + 2 + i));
        const struct cage_site site = {0, ball.x, ball.y, ball.z, ball.r};
        if (cage_box_is_apart(&box, &site))
            f->met[i / 32] &= ~((uint32_t)1 << i % 32);
        else if (cage_box_is_held(&box, &site))
            return NOTHING;
        else
            met = true;
    }
    if (met)
        return PART;
    return is_in(v, cage_read_list(v->atlas, v->chart, f->entry, at->low)) ? WHOLE : NOTHING;
}

static void tell(struct visitor *v, cage_atlas_box *box, int32_t share)
{
    if (share == NOTHING)
        return;
    box->whole = share == WHOLE;
    v->visit(v->context, box);
    v->count++;
}

/* A half of the frame's box, clipped to the box of the class (of class 0: of all balls); false: nothing is left of it. */
static bool half_of_box(const struct visitor *v, const struct box_frame *f, uint32_t half, cage_atlas_box *box)
{
    for (uint32_t k = 0; k < 3; k++) {
        bool used = k < (uint32_t)v->atlas->dim;
        int64_t size = (int64_t)1 << (f->bits - 1), low = f->low[k] + (half >> k & 1 ? size : 0), high = low + size - 1;
        high = high < v->high[k] ? high : v->high[k];
        if (used && (low > high || high < v->low[k]))
            return false;
        box->low[k] = !used ? 0 : low > v->low[k] ? (int32_t)low : v->low[k];
        box->high[k] = used ? (int32_t)high : 0;
    }
    return true;
}

/* The next half of the frame: visited, passed by, or (true) to be halved itself, as *next. */
static bool visit_half(struct visitor *v, struct box_frame *f, struct box_frame *next)
{
    uint32_t half = --f->left, entry = f->listed ? CAGE_CHART_LIST : cage_read_word(v->atlas, f->entry + half);
    cage_atlas_box box;
    if (!half_of_box(v, f, half, &box))
        return false;
    *next = *f;
    for (uint32_t k = 0; k < 3; k++)
        next->low[k] += half >> k & 1 ? (int32_t)1 << (f->bits - 1) : 0;
    next->bits--;
    next->left = (uint32_t)1 << v->atlas->dim;
    if (!f->listed) {
        next->entry = v->chart + (entry >> 2);
        next->listed = (entry & 3) == CAGE_CHART_LIST;
        memset(next->met, 0xff, sizeof next->met);
    }
    if ((entry & 3) == CAGE_CHART_LABEL)
        tell(v, &box, is_in(v, (int32_t)(entry >> 2) - 1) ? WHOLE : NOTHING);
    if ((entry & 3) == CAGE_CHART_SPLIT)
        return next->bits > 0 && v->splits++ < v->atlas->words;
    if ((entry & 3) != CAGE_CHART_LIST || (!f->listed && !may_hold(v, next->entry)))
        return false;
    int32_t part = share_of(v, next, &box);
    if (part == PART && next->bits > 0 && next->bits > v->least)
        return true;
    tell(v, &box, part);
    return false;
}

/* The box that holds all that is looked for; bits of its longest side. */
static int32_t find_bounds(struct visitor *v, uint32_t table)
{
    int32_t bits = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t low = v->class ? table + CAGE_CLASS_LOW : v->chart + CAGE_CHART_LOW;
        uint32_t high = v->class ? table + CAGE_CLASS_HIGH : v->chart + CAGE_CHART_HIGH;
        v->low[k] = cage_read_length(v->atlas, low + k);
        v->high[k] = cage_read_length(v->atlas, high + k);
        while (((int64_t)1 << bits) <= (int64_t)v->high[k] - v->low[k])
            bits++;
    }
    return bits;
}

/* Is a component of the cell of the class? */
static bool is_over(const cage_atlas *atlas, int32_t side, int32_t cell, const struct visitor *v)
{
    uint32_t next = cage_read_side(atlas, side, CAGE_SIDE_LEAF) + 2 * (uint32_t)cell + 3;
    uint32_t end = cell + 1 < atlas->leaves ? cage_read_word(atlas, next) : (uint32_t)atlas->nodes[side];
    bool over = false;
    for (uint32_t node = v->node; node < end && !over; node++)
        over = cage_read_word(atlas, v->of + node) == v->class;
    return over;
}

int64_t cage_atlas_boxes(const cage_atlas *atlas, int32_t side, int32_t cell, int32_t class_number, int32_t halvings,
                         cage_visit *visit, void *context)
{
    if (!is_side(atlas, side) || !visit || cell < 0 || cell >= atlas->leaves || class_number < 0 || halvings < 0 ||
        halvings > MOST_HALVINGS || class_number >= atlas->classes[side == CAGE_SIDE_OUTER])
        return CAGE_ERROR_ARGUMENT;
    uint32_t leaf = cage_read_side(atlas, side == CAGE_SIDE_OUTER, CAGE_SIDE_LEAF) + 2 * (uint32_t)cell;
    struct visitor v = {atlas, cage_read_word(atlas, leaf), cage_read_word(atlas, leaf + 1),
                        cage_read_side(atlas, side == CAGE_SIDE_OUTER, CAGE_SIDE_CLASS), (uint32_t)class_number, 0,
                        {0, 0, 0}, {0, 0, 0}, visit, context, 0, 0};
    int32_t bits = (int32_t)(cage_read_word(atlas, v.chart + CAGE_CHART_BITS) & 31), depth = 0;
    uint32_t table = cage_read_side(atlas, side == CAGE_SIDE_OUTER, CAGE_SIDE_TABLE) + (uint32_t)class_number * CAGE_CLASS_WORDS;
    struct box_frame frame[BOXES_DEEPEST];
    bits = bits < 29 ? bits : 29;
    v.least = find_bounds(&v, table) - halvings;
    /* The root is the low half of a box twice as large, of which nothing else is done. */
    memset(&frame[0], 0, sizeof frame[0]);
    for (uint32_t k = 0; k < 3; k++)
        frame[0].low[k] = cage_read_length(atlas, v.chart + CAGE_CHART_LOW + k);
    frame[0].bits = bits + 1;
    frame[0].entry = v.chart + CAGE_CHART_ROOT;
    frame[0].left = 1;
    if (!is_over(atlas, side == CAGE_SIDE_OUTER, cell, &v))
        return 0;
    while (depth >= 0) {
        if (frame[depth].left == 0)
            depth--;
        else if (visit_half(&v, &frame[depth], &frame[depth + 1]))
            depth++;
    }
    return v.splits > atlas->words ? CAGE_ERROR_ATLAS : v.count;
}
