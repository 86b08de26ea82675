/* query: a pose to its cells, in each a place to its component, the component to its class, read from the bytes of an atlas. */
#include "atlas.h"
#include "body.h"
#include "chart.h"
#include "fibre.h"
#include "grid.h"
#include "words.h"

enum { DEEPEST = CAGE_LEVEL_MAX_2D + 1 };

/* ---- words ---------------------------------------------------------------------------------------------- */

/* Any place may be asked for: beyond the end all words are 0. */
static uint32_t word(const cage_atlas *atlas, uint32_t at)
{
    return at < (uint32_t)atlas->words ? cage_words_get(atlas->byte, at) : 0;
}

static int32_t number(const cage_atlas *atlas, uint32_t at)
{
    return cage_words_number(word(atlas, at));
}

static uint32_t side_word(const cage_atlas *atlas, int32_t side, uint32_t at)
{
    return word(atlas, CAGE_ATLAS_SIDE + (uint32_t)side * CAGE_SIDE_WORDS + at);
}

/* A coordinate or a radius: whatever the bytes are, within what the scene's dimension allows. */
static int32_t length_at(const cage_atlas *atlas, uint32_t at)
{
    int32_t length = number(atlas, at), reach = atlas->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    return length > reach ? reach : length < -reach ? -reach : length;
}

static cage_ball ball_at(const cage_atlas *atlas, uint32_t at)
{
    const uint32_t dim = (uint32_t)atlas->dim;
    const cage_ball ball = {length_at(atlas, at), length_at(atlas, at + 1), dim == 3 ? length_at(atlas, at + 2) : 0,
                            length_at(atlas, at + dim)};
    return ball;
}

/* ---- opening -------------------------------------------------------------------------------------------- */

/* Do count entries of that size, from that place on, lie within the atlas? */
static bool fits(const cage_atlas *atlas, uint32_t place, uint32_t count, uint32_t size)
{
    return place <= (uint32_t)atlas->words && count <= ((uint32_t)atlas->words - place) / size;
}

static bool cells_are_sound(const cage_atlas *atlas)
{
    uint32_t first = word(atlas, CAGE_ATLAS_CELL), cells = word(atlas, CAGE_ATLAS_CELL + 1);
    uint32_t leaves = word(atlas, CAGE_ATLAS_LEAVES);
    uint32_t roots = atlas->dim == 2 ? 2 : 4, children = atlas->dim == 2 ? 2 : 8;
    if (!fits(atlas, first, cells, 1) || cells < roots || leaves > cells)
        return false;
    for (uint32_t i = 0; i < cells; i++) {
        uint32_t entry = word(atlas, first + i), value = entry >> 1;
        if (entry & 1 ? value >= leaves : value <= i || value > cells - children)
            return false;
    }
    return true;
}

static bool side_is_sound(const cage_atlas *atlas, int32_t side)
{
    uint32_t leaves = word(atlas, CAGE_ATLAS_LEAVES), nodes = side_word(atlas, side, CAGE_SIDE_NODES);
    uint32_t classes = side_word(atlas, side, CAGE_SIDE_CLASSES), edges = side_word(atlas, side, CAGE_SIDE_EDGES);
    uint32_t of = side_word(atlas, side, CAGE_SIDE_CLASS), row = side_word(atlas, side, CAGE_SIDE_ROW);
    uint32_t to = side_word(atlas, side, CAGE_SIDE_TO), leaf = side_word(atlas, side, CAGE_SIDE_LEAF);
    uint32_t table = side_word(atlas, side, CAGE_SIDE_TABLE);
    if (!fits(atlas, leaf, leaves, 2) || !fits(atlas, of, nodes, 1) || nodes > INT32_MAX / 2 || !fits(atlas, row, nodes + 1, 1) ||
        !fits(atlas, to, edges, 1) || !fits(atlas, table, classes, CAGE_CLASS_WORDS) || classes == 0)
        return false;
    bool sound = word(atlas, row) == 0 && word(atlas, row + nodes) == edges;
    for (uint32_t i = 0; i < nodes && sound; i++)
        sound = word(atlas, of + i) < classes && word(atlas, row + i) <= word(atlas, row + i + 1);
    for (uint32_t i = 0; i < edges && sound; i++)
        sound = word(atlas, to + i) < nodes;
    for (uint32_t i = 0; i < leaves && sound; i++)
        sound = fits(atlas, word(atlas, leaf + 2 * i), CAGE_CHART_HEAD, 1) && word(atlas, leaf + 2 * i + 1) < nodes;
    return sound;
}

int32_t cage_atlas_open(cage_atlas *atlas, const void *bytes, size_t size)
{
    if (!atlas || !bytes)
        return CAGE_ERROR_ARGUMENT;
    cage_atlas made = {bytes, CAGE_ATLAS_HEAD, 0, 0, {0, 0}, {0, 0}, 0, {0, 0, 0}, {0, 0}};
    if (!cage_words_are_sealed(bytes, size, CAGE_ATLAS_MAGIC_WORD, CAGE_ATLAS_FORMAT_WORD, CAGE_ATLAS_HEAD))
        return CAGE_ERROR_ATLAS;
    made.words = (int32_t)(size / 4);
    made.dim = number(&made, CAGE_ATLAS_DIM);
    made.side = number(&made, CAGE_ATLAS_SIDES);
    if ((made.dim != 2 && made.dim != 3) || made.side < CAGE_SIDE_INNER || made.side > CAGE_SIDE_BOTH || !cells_are_sound(&made))
        return CAGE_ERROR_ATLAS;
    made.leaves = number(&made, CAGE_ATLAS_LEAVES);
    for (uint32_t k = 0; k < 3; k++)
        made.pivot[k] = length_at(&made, CAGE_ATLAS_PIVOT + k);
    for (int32_t side = 0; side < 2; side++) {
        if ((made.side >> side & 1) && !side_is_sound(&made, side))
            return CAGE_ERROR_ATLAS;
        made.classes[side] = (int32_t)side_word(&made, side, CAGE_SIDE_CLASSES);
        made.nodes[side] = (int32_t)side_word(&made, side, CAGE_SIDE_NODES);
        made.note[side] = number(&made, (uint32_t)CAGE_ATLAS_NOTE + (uint32_t)side);
    }
    for (int32_t set = CAGE_ATLAS_OBJECT; set <= CAGE_ATLAS_OBSTACLE; set += 2)
        if (!fits(&made, word(&made, (uint32_t)set), word(&made, (uint32_t)set + 1), (uint32_t)made.dim + 1))
            return CAGE_ERROR_ATLAS;
    *atlas = made;
    return CAGE_OK;
}

/* ---- a chart -------------------------------------------------------------------------------------------- */

/* Does the closed simplex with these vertices hold the point? */
static bool holds(const cage_atlas *atlas, uint32_t chart, uint32_t vertex, const int32_t p[3])
{
    const struct cage_site point = {0, p[0], p[1], p[2], 0};
    struct cage_site site[4];
    for (uint32_t k = 0; k <= (uint32_t)atlas->dim; k++) {
        const cage_ball ball = ball_at(atlas, chart + word(atlas, vertex + k));
        const struct cage_site made = {0, ball.x, ball.y, ball.z, ball.r};
        site[k] = made;
    }
    for (int32_t i = 0; i <= atlas->dim; i++) {
        const int32_t *index = atlas->dim == 2 ? CAGE_FACE_2D[i] : CAGE_FACE_3D[i];
        const struct cage_site *face[3] = {&site[index[0]], &site[index[1]], atlas->dim == 2 ? NULL : &site[index[2]]};
        if (cage_side(atlas->dim, face, &point) < 0)
            return false;
    }
    return true;
}

/* The component at the point of the box that has this list. */
static int32_t look_up(const cage_atlas *atlas, uint32_t chart, uint32_t list, const int32_t p[3])
{
    uint32_t balls = word(atlas, list) & 65535, simplices = word(atlas, list) >> 16, next = list + 2 + balls;
    for (uint32_t i = 0; i < balls; i++) {
        const cage_ball ball = ball_at(atlas, chart + word(atlas, list + 2 + i));
        const struct cage_site site = {0, ball.x, ball.y, ball.z, ball.r};
        if (cage_power(&site, p) <= 0)
            return CAGE_COVERED;
    }
    for (uint32_t i = 0; i < simplices; i++, next += (uint32_t)atlas->dim + 2)
        if (holds(atlas, chart, next + 1, p))
            return number(atlas, next);
    return number(atlas, list + 1);
}

/* The component of the slice at a grid point with |coordinates| <= CAGE_REACH. */
static int32_t component_at(const cage_atlas *atlas, uint32_t chart, const int32_t p[3])
{
    const uint32_t dim = (uint32_t)atlas->dim;
    for (uint32_t k = 0; k < dim; k++)
        if (p[k] < number(atlas, chart + CAGE_CHART_LOW + k) || p[k] > number(atlas, chart + CAGE_CHART_HIGH + k))
            return CAGE_OUTSIDE;
    uint32_t entry = word(atlas, chart + CAGE_CHART_ROOT);
    for (uint32_t bits = word(atlas, chart + CAGE_CHART_BITS) & 31; (entry & 3) == CAGE_CHART_SPLIT && bits > 0;) {
        uint32_t half = 0;
        bits--;
        for (uint32_t k = 0; k < dim; k++)
            half |= (((uint32_t)p[k] - word(atlas, chart + CAGE_CHART_LOW + k)) >> bits & 1) << k;
        entry = word(atlas, chart + (entry >> 2) + half);
    }
    if ((entry & 3) == CAGE_CHART_LABEL)
        return (int32_t)(entry >> 2) - 1;
    return (entry & 3) == CAGE_CHART_LIST ? look_up(atlas, chart, chart + (entry >> 2), p) : CAGE_COVERED;
}

/* ---- the cells that hold a rotation --------------------------------------------------------------------- */

/* A way down the tree of cells, one child after the other. */
struct descent {
    struct cage_cell cell[DEEPEST]; /* at each level the one it is at */
    uint32_t entry[DEEPEST];        /* where the entries of it and its siblings begin */
    int32_t index[DEEPEST];         /* which of them it is, -1: before the first */
    int32_t depth;
};

/* The next leaf whose closed cell holds q, or -1. */
static int32_t next_leaf(const cage_atlas *atlas, struct descent *at, const int32_t q[4])
{
    const struct cage_fibre *fibre = atlas->dim == 2 ? &cage_so2 : &cage_so3;
    uint32_t first = word(atlas, CAGE_ATLAS_CELL);
    while (at->depth >= 0) {
        int32_t depth = at->depth, index = ++at->index[depth];
        if (index == (depth == 0 ? fibre->roots : fibre->children)) {
            at->depth--;
            continue;
        }
        const struct cage_cell root = {0, index, {0, 0, 0}};
        at->cell[depth] = root;
        if (depth > 0)
            fibre->child(&at->cell[depth - 1], index, &at->cell[depth]);
        if (!fibre->contains(&at->cell[depth], q))
            continue;
        uint32_t entry = word(atlas, at->entry[depth] + (uint32_t)index);
        if (entry & 1)
            return (int32_t)(entry >> 1);
        if (depth == fibre->max_level)
            continue;
        at->depth++;
        at->entry[depth + 1] = first + (entry >> 1);
        at->index[depth + 1] = -1;
    }
    return -1;
}

/* The class of the pivot's place on a side: on the inner side covered if it is over any cell, on the outer if over all. */
static int32_t class_at(const cage_atlas *atlas, const int32_t q[4], const int32_t at[3], int32_t side)
{
    struct descent descent;
    int32_t class = CAGE_NO_CLASS, leaf;
    descent.depth = 0;
    descent.index[0] = -1;
    descent.entry[0] = word(atlas, CAGE_ATLAS_CELL);
    while ((leaf = next_leaf(atlas, &descent, q)) >= 0) {
        uint32_t entry = side_word(atlas, side, CAGE_SIDE_LEAF) + 2 * (uint32_t)leaf;
        int32_t component = component_at(atlas, word(atlas, entry), at);
        if (component < 0 && side == 0)
            return CAGE_NO_CLASS;
        if (component < 0)
            continue;
        uint32_t node = word(atlas, entry + 1) + (uint32_t)component;
        class = (int32_t)word(atlas, side_word(atlas, side, CAGE_SIDE_CLASS) + node);
        if (side == 1)
            break; /* a place that is free over several is in one class */
    }
    return class;
}

/* ---- collisions ----------------------------------------------------------------------------------------- */

/* The first obstacle whose x is not below that, or their number. */
static uint32_t first_from(const cage_atlas *atlas, int64_t x)
{
    uint32_t place = word(atlas, CAGE_ATLAS_OBSTACLE), size = (uint32_t)atlas->dim + 1, low = 0;
    uint32_t high = word(atlas, CAGE_ATLAS_OBSTACLE + 1);
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (number(atlas, place + size * middle) < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Does the object's ball overlap an obstacle? at: where its centre is, each coordinate to less than 1. */
static bool ball_collides(const cage_atlas *atlas, const cage_pose *pose, const cage_ball *y, const int64_t at[3])
{
    uint32_t size = (uint32_t)atlas->dim + 1, obstacles = word(atlas, CAGE_ATLAS_OBSTACLE + 1);
    int64_t far = (int64_t)y->r + length_at(atlas, CAGE_ATLAS_LARGEST) + 1; /* on no axis are those that overlap farther apart */
    uint32_t from = first_from(atlas, at[0] - far), place = word(atlas, CAGE_ATLAS_OBSTACLE) + size * from;
    for (uint32_t j = from; j < obstacles && number(atlas, place) <= at[0] + far; j++, place += size) {
        const cage_ball x = ball_at(atlas, place);
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
    uint32_t object = word(atlas, CAGE_ATLAS_OBJECT), objects = word(atlas, CAGE_ATLAS_OBJECT + 1);
    struct cage_rotation rotation;
    cage_rotation_of(pose->q, &rotation);
    for (uint32_t i = 0; i < objects; i++) {
        const cage_ball y = ball_at(atlas, object + ((uint32_t)atlas->dim + 1) * i);
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

/* The cell that was cut into the one with that number and its siblings; its own number if there is none. */
static uint32_t parent_of(const cage_atlas *atlas, uint32_t at, uint32_t children, uint32_t *index)
{
    uint32_t first = word(atlas, CAGE_ATLAS_CELL), parent = 0;
    for (; parent < at; parent++) {
        uint32_t entry = word(atlas, first + parent), child = entry >> 1;
        *index = at - child;
        if (!(entry & 1) && child <= at && *index < children)
            break;
    }
    return parent;
}

/* The representative rotation of the leaf with that number: its cell is looked for in the whole tree. */
static bool rotation_of(const cage_atlas *atlas, uint32_t leaf, int32_t q[4])
{
    const struct cage_fibre *fibre = atlas->dim == 2 ? &cage_so2 : &cage_so3;
    uint32_t first = word(atlas, CAGE_ATLAS_CELL), cells = word(atlas, CAGE_ATLAS_CELL + 1), at = 0, index = 0;
    int32_t way[DEEPEST], depth = 0;
    while (at < cells && word(atlas, first + at) != (leaf << 1 | 1))
        at++;
    for (; at >= (uint32_t)fibre->roots; way[depth++] = (int32_t)index) {
        uint32_t parent = at < cells ? parent_of(atlas, at, (uint32_t)fibre->children, &index) : at;
        if (parent == at || depth == fibre->max_level)
            return false;
        at = parent;
    }
    struct cage_cell cell = {0, (int32_t)at, {0, 0, 0}};
    while (depth > 0)
        fibre->child(&cell, way[--depth], &cell);
    fibre->representative(&cell, q);
    return true;
}

int32_t cage_atlas_class(const cage_atlas *atlas, int32_t side, int32_t class_number, cage_class *out)
{
    if (!atlas || !out || (side != CAGE_SIDE_INNER && side != CAGE_SIDE_OUTER) || !(atlas->side & side) || class_number < 0 ||
        class_number >= atlas->classes[side == CAGE_SIDE_OUTER])
        return CAGE_ERROR_ARGUMENT;
    uint32_t at = side_word(atlas, side == CAGE_SIDE_OUTER, CAGE_SIDE_TABLE) + (uint32_t)class_number * CAGE_CLASS_WORDS;
    cage_class made = {number(atlas, at + CAGE_CLASS_CELLS), number(atlas, at + CAGE_CLASS_NODES), {0, 0, 0}, {0, 0, 0},
                       0, {{0, 0, 0}, {1, 0, 0, 0}}};
    for (uint32_t k = 0; k < 3; k++) {
        made.low[k] = number(atlas, at + CAGE_CLASS_LOW + k);
        made.high[k] = number(atlas, at + CAGE_CLASS_HIGH + k);
        made.pose.x[k] = number(atlas, at + CAGE_CLASS_AT + k);
    }
    if (word(atlas, at + CAGE_CLASS_LEAF) > 0)
        made.known = rotation_of(atlas, word(atlas, at + CAGE_CLASS_LEAF) - 1, made.pose.q);
    *out = made;
    return CAGE_OK;
}
