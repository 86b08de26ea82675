/* query: a pose to its cells, in each a place to its component, the component to its class, read from the bytes of an atlas. */
#include "body.h"
#include "chart.h"
#include "grid.h"
#include "read.h"

#include <string.h>

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
    struct cage_cell cell;   /* the parent of those at the depth it is at (of the roots: level -1), or one of them */
    uint32_t entry[DEEPEST]; /* at each depth, where the entries of a cell and its siblings begin */
    int8_t index[DEEPEST];   /* which of them is the next */
    int8_t depth;            /* -1: above the roots */
};

static void descend(struct descent *at, uint32_t entry)
{
    at->depth++;
    at->entry[at->depth] = entry;
    at->index[at->depth] = 0;
}

static void to_child(struct descent *at, int32_t index)
{
    at->cell.face = at->depth == 0 ? index : at->cell.face;
    cage_cell_child(&at->cell, at->depth == 0 ? 0 : index, &at->cell);
}

/* To the parent of the cell: a box of twice the size. */
static void to_parent(struct descent *at)
{
    at->cell.level--;
    for (int32_t k = 0; k < 3; k++)
        at->cell.at[k] >>= 1;
}

/* The next leaf whose closed cell holds q, or -1. */
static int32_t next_leaf(const cage_atlas *atlas, struct descent *at, const int32_t q[4])
{
    const bool flat = atlas->dim == 2;
    const int32_t roots = flat ? CAGE_ROOTS_2D : CAGE_ROOTS_3D, children = flat ? CAGE_CHILDREN_2D : CAGE_CHILDREN_3D;
    uint32_t first = cage_read_word(atlas, CAGE_ATLAS_CELL);
    while (at->depth >= 0) {
        int32_t index = at->index[at->depth]++;
        if (index == (at->depth == 0 ? roots : children)) {
            at->depth--;
            to_parent(at);
            continue;
        }
        uint32_t entry = cage_read_word(atlas, at->entry[at->depth] + (uint32_t)index);
        to_child(at, index);
        bool inside = flat ? cage_so2_contains(&at->cell, q) : cage_so3_contains(&at->cell, q);
        if (inside && !(entry & 1) && at->depth < (flat ? CAGE_LEVEL_MAX_2D : CAGE_LEVEL_MAX_3D)) {
            descend(at, first + (entry >> 1));
            continue;
        }
        to_parent(at);
        if (inside && (entry & 1))
            return (int32_t)(entry >> 1);
    }
    return -1;
}

/* The class of the pivot's place on a side: on the inner side covered if it is over any cell, on the outer if over all. */
static int32_t class_at(const cage_atlas *atlas, const int32_t q[4], const int32_t at[3], int32_t side)
{
    struct descent descent;
    int32_t class = CAGE_NO_CLASS, leaf;
    memset(&descent.cell, 0, sizeof descent.cell);
    descent.cell.level = descent.depth = -1;
    descend(&descent, cage_read_word(atlas, CAGE_ATLAS_CELL));
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
            break; /* any will do: what is joined to one of them is joined to the pose */
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

/* Differences < 2^30 + 2^28. */
static int64_t square_between(const int32_t at[3], const cage_ball *x)
{
    int64_t a = (int64_t)at[0] - x->x, b = (int64_t)at[1] - x->y, c = (int64_t)at[2] - x->z;
    return a * a + b * b + c * c;
}

/* To within this is told where a ball of the object is: each coordinate, and the point. See cage_rough_rotate. */
enum { OFF_BY = 3, AWAY_BY = 4 };

/* A ball of the object and an obstacle so near to touching that 32 bits do not tell whether they overlap; their numbers, that of
 * the obstacle plus 1. */
struct pair {
    cage_ball y, x;
    uint32_t i, j;
};

enum { CLEAR, NEAR, OVERLAP };

/* The next such pair after this one, of the same ball, whose centre is there about; or two that do overlap. */
static int32_t next_of_ball(const cage_atlas *atlas, const int32_t at[3], struct pair *pair)
{
    uint32_t size = (uint32_t)atlas->dim + 1, obstacles = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE + 1);
    int64_t far = (int64_t)pair->y.r + cage_read_length(atlas, CAGE_ATLAS_LARGEST) + OFF_BY; /* no farther apart on an axis */
    uint32_t j = pair->j > 0 ? pair->j : first_from(atlas, at[0] - far);
    uint32_t place = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE) + size * j;
    for (; j < obstacles && cage_read_number(atlas, place) <= at[0] + far; j++, place += size) {
        int64_t aside = (int64_t)cage_read_number(atlas, place + 1) - at[1];
        if (aside > far || -aside > far)
            continue;
        pair->x = cage_read_ball(atlas, place);
        int64_t square = square_between(at, &pair->x), sum = (int64_t)pair->x.r + pair->y.r;
        if (square >= (sum + AWAY_BY) * (sum + AWAY_BY))
            continue;
        pair->j = j + 1;
        return sum >= AWAY_BY && square < (sum - AWAY_BY) * (sum - AWAY_BY) ? OVERLAP : NEAR;
    }
    return CLEAR;
}

static int32_t next_pair(const cage_atlas *atlas, const cage_pose *pose, struct pair *pair)
{
    uint32_t object = cage_read_word(atlas, CAGE_ATLAS_OBJECT), objects = cage_read_word(atlas, CAGE_ATLAS_OBJECT + 1);
    int32_t found = CLEAR, at[3];
    struct cage_rough rough;
    cage_rough_of(pose->q, &rough);
    for (; pair->i < objects; pair->i++, pair->j = 0) {
        pair->y = cage_read_ball(atlas, object + ((uint32_t)atlas->dim + 1) * pair->i);
        const int32_t y[3] = {pair->y.x, pair->y.y, pair->y.z};
        cage_rough_rotate(&rough, y, at);
        for (int32_t k = 0; k < 3; k++)
            at[k] += pose->x[k]; /* < 2^30 */
        found = next_of_ball(atlas, at, pair);
        if (found != CLEAR)
            break;
    }
    return found;
}

/* Are all obstacles farther from the pivot, which is less than 1 from `at`, than any of the object's balls reaches? */
static bool is_far(const cage_atlas *atlas, const int32_t at[3])
{
    uint32_t size = (uint32_t)atlas->dim + 1, obstacles = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE + 1);
    int64_t extent = (int64_t)cage_read_length(atlas, CAGE_ATLAS_EXTENT) + 1;
    int64_t far = extent + cage_read_length(atlas, CAGE_ATLAS_LARGEST);
    uint32_t from = first_from(atlas, at[0] - far), place = cage_read_word(atlas, CAGE_ATLAS_OBSTACLE) + size * from;
    for (uint32_t j = from; j < obstacles && cage_read_number(atlas, place) <= at[0] + far; j++, place += size) {
        int64_t aside = cage_read_number(atlas, place + 1) - (int64_t)at[1];
        if (aside > far || -aside > far)
            continue;
        const cage_ball x = cage_read_ball(atlas, place);
        int64_t reach = extent + x.r;
        if (square_between(at, &x) < reach * reach)
            return false;
    }
    return true;
}

/* Do any inner balls overlap at the pose (user's frame)? at: the place of the pivot. */
static bool collides(const cage_atlas *atlas, const cage_pose *pose, const int32_t at[3])
{
    struct pair pair;
    if (is_far(atlas, at))
        return false;
    pair.i = pair.j = 0;
    int32_t found = next_pair(atlas, pose, &pair);
    while (found == NEAR && !cage_pair_collides(pose, &pair.y, &pair.x))
        found = next_pair(atlas, pose, &pair);
    return found != CLEAR;
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

/* The classes of a pose on both sides; false: it collides, this tells. */
static bool place(const cage_atlas *atlas, const cage_pose *pose, const int32_t at[3], int32_t class[2])
{
    class[0] = class[1] = CAGE_NO_CLASS;
    if (atlas->side & CAGE_SIDE_INNER) {
        class[0] = class_at(atlas, pose->q, at, 0);
        if (class[0] == CAGE_NO_CLASS)
            return false;
    }
    if (atlas->side & CAGE_SIDE_OUTER)
        class[1] = class_at(atlas, pose->q, at, 1);
    return true;
}

int32_t cage_atlas_ask(const cage_atlas *atlas, const cage_pose *start, const cage_pose *goal)
{
    int32_t from[2], to[2] = {CAGE_OUTSIDE, CAGE_OUTSIDE}, at[2][3];
    int32_t error = check(atlas, start, at[0]);
    if (error == CAGE_OK && goal)
        error = check(atlas, goal, at[1]);
    if (error != CAGE_OK)
        return error;
    if (!place(atlas, start, at[0], from) || (from[1] == CAGE_NO_CLASS && collides(atlas, start, at[0])))
        return CAGE_IN_COLLISION;
    if (goal && (!place(atlas, goal, at[1], to) || (to[1] == CAGE_NO_CLASS && collides(atlas, goal, at[1]))))
        return CAGE_IN_COLLISION;
    if (from[0] != CAGE_NO_CLASS && to[0] != CAGE_NO_CLASS && from[0] != to[0])
        return goal ? CAGE_DISCONNECTED : CAGE_CAGED;
    if (from[1] != CAGE_NO_CLASS && from[1] == to[1])
        return goal ? CAGE_CONNECTED : CAGE_FREE;
    return CAGE_UNDEFINED;
}
