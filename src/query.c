/* query: a pose to its cells, in each a place to its component, the component to its class, read from the bytes of an atlas. */
#include "body.h"
#include "chart.h"
#include "grid.h"
#include "read.h"

enum { DEEPEST = CAGE_LEVEL_MAX_2D + 1 };

/* ---- a chart -------------------------------------------------------------------------------------------- */

/* The component of the slice at a grid point with |coordinates| <= CAGE_REACH. */
static int32_t component_at(const cage_atlas *atlas, uint32_t chart, const int32_t p[3])
{
    const uint32_t dim = (uint32_t)atlas->dim;
    for (uint32_t k = 0; k < dim; k++)
        if (p[k] < cage_read_number(atlas, chart + CAGE_CHART_LOW + k) ||
            p[k] > cage_read_number(atlas, chart + CAGE_CHART_HIGH + k))
            return CAGE_OUTSIDE;
    uint32_t entry = cage_read_word(atlas, chart + CAGE_CHART_ROOT);
    for (uint32_t bits = cage_read_word(atlas, chart + CAGE_CHART_BITS) & 31; (entry & 3) == CAGE_CHART_SPLIT && bits > 0;) {
        uint32_t half = 0;
        bits--;
        for (uint32_t k = 0; k < dim; k++)
            half |= (((uint32_t)p[k] - cage_read_word(atlas, chart + CAGE_CHART_LOW + k)) >> bits & 1) << k;
        entry = cage_read_word(atlas, chart + (entry >> 2) + half);
    }
    if ((entry & 3) == CAGE_CHART_LABEL)
        return (int32_t)(entry >> 2) - 1;
    return (entry & 3) == CAGE_CHART_LIST ? cage_read_list(atlas, chart, chart + (entry >> 2), p) : CAGE_COVERED;
}

/* ---- the cells that hold a rotation --------------------------------------------------------------------- */

/* A way down the tree of cells, one child after the other. */
struct descent {
    struct cage_cell cell;   /* the parent of those at the depth it is at (of the roots: none) */
    uint32_t entry[DEEPEST]; /* at each depth, where the entries of a cell and its siblings begin */
    int8_t index[DEEPEST];   /* which of them is the next */
    int32_t depth;
};

static void descend(struct descent *at, const struct cage_cell *cell, uint32_t entry)
{
    at->cell = *cell;
    at->depth++;
    at->entry[at->depth] = entry;
    at->index[at->depth] = 0;
}

/* Back to the parent of the cell: a box of twice the size. */
static void ascend(struct descent *at)
{
    at->depth--;
    at->cell.level--;
    for (int32_t k = 0; k < 3; k++)
        at->cell.at[k] >>= 1;
}

/* The next leaf whose closed cell holds q, or -1. */
static int32_t next_leaf(const cage_atlas *atlas, struct descent *at, const int32_t q[4])
{
    const struct cage_fibre *fibre = cage_read_fibre(atlas);
    uint32_t first = cage_read_word(atlas, CAGE_ATLAS_CELL);
    while (at->depth >= 0) {
        int32_t depth = at->depth, index = at->index[depth]++;
        if (index == (depth == 0 ? fibre->roots : fibre->children)) {
            ascend(at);
            continue;
        }
        struct cage_cell cell = {0, index, {0, 0, 0}};
        if (depth > 0)
            fibre->child(&at->cell, index, &cell);
        if (!fibre->contains(&cell, q))
            continue;
        uint32_t entry = cage_read_word(atlas, at->entry[depth] + (uint32_t)index);
        if (entry & 1)
            return (int32_t)(entry >> 1);
        if (depth < fibre->max_level)
            descend(at, &cell, first + (entry >> 1));
    }
    return -1;
}

/* The class of the pivot's place on a side: on the inner side covered if it is over any cell, on the outer if over all. */
static int32_t class_at(const cage_atlas *atlas, const int32_t q[4], const int32_t at[3], int32_t side)
{
    const struct cage_cell none = {-1, 0, {0, 0, 0}};
    struct descent descent;
    int32_t class = CAGE_NO_CLASS, leaf;
    descent.depth = -1;
    descend(&descent, &none, cage_read_word(atlas, CAGE_ATLAS_CELL));
    while ((leaf = next_leaf(atlas, &descent, q)) >= 0) {
        uint32_t entry = cage_read_side(atlas, side, CAGE_SIDE_LEAF) + 2 * (uint32_t)leaf;
        int32_t component = component_at(atlas, cage_read_word(atlas, entry), at);
        if (component < 0 && side == 0)
            return CAGE_NO_CLASS;
        if (component < 0)
            continue;
        uint32_t node = cage_read_word(atlas, entry + 1) + (uint32_t)component;
        class = (int32_t)cage_read_word(atlas, cage_read_side(atlas, side, CAGE_SIDE_CLASS) + node);
        if (side == 1)
            break; /* a place that is free over several is in one class */
    }
    return class;
}

/* ---- collisions ----------------------------------------------------------------------------------------- */

/* The first obstacle whose x is not below that, or their number. */
static uint32_t first_from(const cage_atlas *atlas, int64_t x)
{
    uint32_t place = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE), size = (uint32_t)atlas->dim + 1, low = 0;
    uint32_t high = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE + 1);
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (cage_read_number(atlas, place + size * middle) < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Does the object's ball overlap an obstacle? at: where its centre is, each coordinate to less than 1. */
static bool ball_collides(const cage_atlas *atlas, const cage_pose *pose, const cage_ball *y, const int64_t at[3])
{
    uint32_t size = (uint32_t)atlas->dim + 1, obstacles = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE + 1);
    int64_t far = (int64_t)y->r + cage_read_length(atlas, CAGE_ATLAS_LARGEST) + 1; /* no farther apart on an axis */
    uint32_t from = first_from(atlas, at[0] - far), place = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE) + size * from;
    for (uint32_t j = from; j < obstacles && cage_read_number(atlas, place) <= at[0] + far; j++, place += size) {
        int64_t aside = cage_read_number(atlas, place + 1) - at[1];
        if (aside > far || -aside > far)
            continue;
        const cage_ball x = cage_read_ball(atlas, place);
        const int64_t apart[3] = {at[0] - x.x, at[1] - x.y, at[2] - x.z}; /* < 2^30, the vector off by less than 1 */
        int64_t square = apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2], reach = (int64_t)x.r + y->r + 1;
        if (square >= reach * reach)
            continue;
        if ((reach >= 2 && square < (reach - 2) * (reach - 2)) || cage_pair_collides(pose, y, &x))
            return true;
    }
    return false;
}

/* Do any inner balls overlap at the pose (user's frame)? */
static bool collides(const cage_atlas *atlas, const cage_pose *pose)
{
    uint32_t object = cage_read_word(atlas, CAGE_ATLAS_OBJECT), objects = cage_read_word(atlas, CAGE_ATLAS_OBJECT + 1);
    struct cage_rotation rotation;
    cage_rotation_of(pose->q, &rotation);
    for (uint32_t i = 0; i < objects; i++) {
        const cage_ball y = cage_read_ball(atlas, object + ((uint32_t)atlas->dim + 1) * i);
        const int32_t from[3] = {y.x, y.y, y.z};
        int32_t to[3];
        cage_rotate(&rotation, from, to);
        const int64_t at[3] = {(int64_t)to[0] + pose->x[0], (int64_t)to[1] + pose->x[1], (int64_t)to[2] + pose->x[2]};
        if (ball_collides(atlas, pose, &y, at))
            return true;
    }
    return false;
}

/* ---- questions ------------------------------------------------------------------------------------------ */

static int32_t check(const cage_atlas *atlas, const cage_pose *pose, int32_t at[3])
{
    if (!atlas || !pose)
        return CAGE_ERROR_ARGUMENT;
    int32_t error = cage_pose_check(atlas->dim, pose), reach = atlas->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    if (error != CAGE_OK)
        return error;
    cage_pose_pivot(pose, atlas->pivot, at);
    for (int32_t k = 0; k < 3; k++)
        if (at[k] < -reach || at[k] > reach)
            return CAGE_ERROR_RANGE;
    return CAGE_OK;
}

int32_t cage_atlas_locate(const cage_atlas *atlas, const cage_pose *pose, int32_t side)
{
    int32_t at[3], error = check(atlas, pose, at);
    if (error == CAGE_OK && ((side != CAGE_SIDE_INNER && side != CAGE_SIDE_OUTER) || !(atlas->side & side)))
        error = CAGE_ERROR_ARGUMENT;
    return error != CAGE_OK ? error : class_at(atlas, pose->q, at, side == CAGE_SIDE_OUTER);
}

/* The classes of a pose on both sides; does it collide? */
static bool place(const cage_atlas *atlas, const cage_pose *pose, const int32_t at[3], int32_t class[2])
{
    class[0] = class[1] = CAGE_NO_CLASS;
    if (atlas->side & CAGE_SIDE_INNER) {
        class[0] = class_at(atlas, pose->q, at, 0);
        if (class[0] == CAGE_NO_CLASS)
            return true;
    }
    if (atlas->side & CAGE_SIDE_OUTER)
        class[1] = class_at(atlas, pose->q, at, 1);
    return class[1] == CAGE_NO_CLASS && collides(atlas, pose);
}

int32_t cage_atlas_ask(const cage_atlas *atlas, const cage_pose *start, const cage_pose *goal)
{
    int32_t from[2], to[2] = {CAGE_OUTSIDE, CAGE_OUTSIDE}, at[2][3];
    int32_t error = check(atlas, start, at[0]);
    if (error == CAGE_OK && goal)
        error = check(atlas, goal, at[1]);
    if (error != CAGE_OK)
        return error;
    if (place(atlas, start, at[0], from) || (goal && place(atlas, goal, at[1], to)))
        return CAGE_IN_COLLISION;
    if (from[0] != CAGE_NO_CLASS && to[0] != CAGE_NO_CLASS && from[0] != to[0])
        return goal ? CAGE_DISCONNECTED : CAGE_CAGED;
    if (from[1] != CAGE_NO_CLASS && from[1] == to[1])
        return goal ? CAGE_CONNECTED : CAGE_FREE;
    return CAGE_UNDEFINED;
}
