/* cubes.c: the cells of space's rotations once more: boxes on the boundary of the whole cube [-1, 1]^4, in exact integers. */
#include "cubes.h"

struct cube_box cube_of(const struct cage_cell *cell)
{
    struct cube_box box;
    int32_t size = CUBE_WIDTH >> cell->level, axis = 0;
    for (int32_t e = 0; e < 4; e++) {
        box.low[e] = e == cell->face ? CUBE_WIDTH : cell->at[axis++] * size;
        box.high[e] = e == cell->face ? CUBE_WIDTH : box.low[e] + size;
    }
    return box;
}

static struct cube_box opposite(const struct cube_box *box)
{
    struct cube_box other;
    for (int32_t e = 0; e < 4; e++) {
        other.low[e] = CUBE_WIDTH - box->high[e];
        other.high[e] = CUBE_WIDTH - box->low[e];
    }
    return other;
}

/* With s the entry divided by the largest, s = t (|t| + 2) / 3 says |t| + 1 = sqrt(1 + 3 |s|); in units of which [-1,
 * 1] has CUBE_WIDTH, t >= 0 is u = (t + 1) CUBE_WIDTH / 2 and u^2 = CUBE_WIDTH^2 / 4 (1 + 3 s). Terms <= 2^22 2^30
 * and 2^20 2^32. */
struct cube_box cube_point(const int32_t q[4])
{
    struct cube_box point;
    int64_t largest = 0, unit = CUBE_WIDTH / 2;
    for (int32_t e = 0; e < 4; e++) {
        int64_t size = q[e] < 0 ? -(int64_t)q[e] : q[e];
        largest = size > largest ? size : largest;
    }
    for (int32_t e = 0; e < 4; e++) {
        int64_t size = q[e] < 0 ? -(int64_t)q[e] : q[e], right = unit * unit * (largest + 3 * size);
        int32_t u = CUBE_WIDTH;
        while ((int64_t)u * u * largest > right)
            u--;
        int32_t next = u + ((int64_t)u * u * largest < right);
        point.low[e] = q[e] < 0 ? CUBE_WIDTH - next : u;
        point.high[e] = q[e] < 0 ? CUBE_WIDTH - u : next;
    }
    return point;
}

static bool inside(const struct cube_box *box, const struct cube_box *point)
{
    bool in = true;
    for (int32_t e = 0; e < 4; e++)
        in = in && box->low[e] <= point->low[e] && point->high[e] <= box->high[e];
    return in;
}

/* Strictly on the box's three long axes. */
static bool within(const struct cube_box *box, const struct cube_box *point)
{
    bool in = inside(box, point);
    for (int32_t e = 0; e < 4; e++)
        in = in && (box->low[e] == box->high[e] || (box->low[e] < point->high[e] && point->low[e] < box->high[e]));
    return in;
}

bool cube_holds(const struct cage_cell *cell, const struct cube_box *point)
{
    struct cube_box box = cube_of(cell), other = opposite(point);
    return inside(&box, point) || inside(&box, &other);
}

bool cube_holds_within(const struct cage_cell *cell, const struct cube_box *point)
{
    struct cube_box box = cube_of(cell), other = opposite(point);
    return within(&box, point) || within(&box, &other);
}

static int intersect(const struct cube_box *a, const struct cube_box *b, int64_t *volume)
{
    int dimension = 0;
    *volume = 1;
    for (int32_t e = 0; e < 4; e++) {
        int32_t low = a->low[e] > b->low[e] ? a->low[e] : b->low[e];
        int32_t high = a->high[e] < b->high[e] ? a->high[e] : b->high[e];
        if (low > high)
            return -1;
        dimension += low < high;
        *volume *= low < high ? high - low : 1;
    }
    return dimension;
}

int cube_shared(const struct cage_cell *a, const struct cage_cell *b, int64_t *area)
{
    struct cube_box one = cube_of(a), two = cube_of(b), other = opposite(&two);
    int64_t volume[2];
    int near = intersect(&one, &two, &volume[0]), far = intersect(&one, &other, &volume[1]);
    *area = (near == 2 ? volume[0] : 0) + (far == 2 ? volume[1] : 0);
    return near > far ? near : far;
}
