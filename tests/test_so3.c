/* test_so3.c: cells of space's rotations: they tile them, know their neighbours and bound what they move. */
#include "support.h"

#include <math.h>
#include <stdlib.h>

#include "cage.h"
#include "cubes.h"
#include "grid.h"

enum { MOST = 300, ENTRY = 1 << 24 };

static const struct cage_fibre *const fibre = &cage_so3;

/* Any quaternion but 0, entries up to 2^24 or at times 2^30: of every size, with zeros, with equal and opposite entries. */
static void any_rotation(uint64_t *state, int32_t q[4])
{
    int64_t limit = random_next(state) % 8 ? ENTRY : 1 << 30;
    int32_t kind = (int32_t)test_between(state, 0, 5);
    do {
        for (int e = 0; e < 4; e++) {
            q[e] = (int32_t)(kind == 0   ? test_between(state, -3, 3)
                             : kind == 1 ? test_between(state, -1, 1) * limit
                             : kind == 2 ? test_between(state, -limit, limit)
                                         : test_spread(state, limit));
            if (kind == 4 && random_next(state) & 1)
                q[e] = 0;
            if (kind >= 4 && e > 0 && random_next(state) & 1)
                q[e] = (random_next(state) & 1 ? 1 : -1) * q[test_between(state, 0, e - 1)];
        }
    } while (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0);
}

/* g(m / one) = (m / one) (|m| / one + 2) / 3, times 3 one^2. */
static int32_t slope(int32_t m, int32_t one) { return m * (abs(m) + 2 * one); }

/* A rotation of the cell, by the design's formula, with `ends` of its three axes at an end and the others between;
 * entries <= 2^24. */
static void rotation_within(uint64_t *state, const struct cage_cell *cell, int32_t ends, int32_t q[4])
{
    int32_t one = 1 << cell->level, most = ENTRY / (3 * one * one), order[3];
    int64_t scale = random_next(state) & 1 ? most : test_between(state, 1, most), sign = random_next(state) & 1 ? 1 : -1;
    test_shuffle(state, order, 3);
    for (int32_t e = 0, k = 0; e < 4; e++) {
        if (e == cell->face) {
            q[e] = (int32_t)(sign * scale * 3 * one * one);
            continue;
        }
        int64_t low = scale * slope(2 * cell->at[k] - one, one), high = scale * slope(2 * cell->at[k] + 2 - one, one);
        int64_t end = random_next(state) & 1 ? low : high;
        q[e] = (int32_t)(sign * (order[k++] < ends ? end : test_between(state, low + 1, high - 1)));
    }
}

static void corner(const struct cage_cell *cell, int32_t index, int32_t q[4])
{
    int32_t one = 1 << cell->level;
    for (int32_t e = 0, k = 0; e < 4; e++) {
        q[e] = 3 * one * one;
        if (e == cell->face)
            continue;
        q[e] = slope(2 * (cell->at[k] + (index >> k & 1)) - one, one);
        k++;
    }
}

/* Start from the roots and replace cells by their children: anywhere, the latest, or those next to one rotation. */
static int32_t refine(uint64_t *state, int32_t cells, struct cage_cell *cell)
{
    int32_t count = 0, way = (int32_t)test_between(state, 0, 2), q[4];
    for (int32_t face = 0; face < fibre->roots; face++) {
        const struct cage_cell root = {0, face, {0, 0, 0}};
        cell[count++] = root;
    }
    any_rotation(state, q);
    struct cube_box focus = cube_point(q);
    for (int32_t tries = 0; count + fibre->children - 1 <= cells && tries < 100 * cells; tries++) {
        int32_t i = (int32_t)test_between(state, way == 1 && count > 8 ? count - 8 : 0, count - 1);
        struct cage_cell parent = cell[i];
        if (parent.level == fibre->max_level || (way == 2 && !cube_holds(&parent, &focus) && random_next(state) % 64))
            continue;
        cage_cell_child(&parent, 0, &cell[i]);
        for (int32_t k = 1; k < fibre->children; k++)
            cage_cell_child(&parent, k, &cell[count++]);
    }
    return count;
}

static struct cage_cell any_cell(uint64_t *state)
{
    struct cage_cell cell = {(int32_t)test_between(state, 0, fibre->max_level), (int32_t)test_between(state, 0, 3), {0, 0, 0}};
    for (int k = 0; k < 3; k++) {
        int32_t last = (1 << cell.level) - 1;
        cell.at[k] = (int32_t)(random_next(state) & 1 ? test_between(state, 0, last) : test_between(state, 0, 4) * last / 4);
    }
    return cell;
}

/* A cell of any level that holds this point of the cube, on any of the faces that it is on. */
static struct cage_cell cell_at(uint64_t *state, const int32_t u[4])
{
    struct cage_cell cell = {(int32_t)test_between(state, 0, fibre->max_level), 0, {0, 0, 0}};
    do
        cell.face = (int32_t)test_between(state, 0, 3);
    while (u[cell.face] != 0 && u[cell.face] != CUBE_WIDTH);
    int32_t size = CUBE_WIDTH >> cell.level;
    for (int32_t e = 0, k = 0; e < 4; e++) {
        int32_t at = u[cell.face] == 0 ? CUBE_WIDTH - u[e] : u[e];
        if (e != cell.face)
            cell.at[k++] = at / size - (at == CUBE_WIDTH || (at > 0 && at % size == 0 && random_next(state) & 1));
    }
    return cell;
}

static void check_contains(const struct cage_cell *cell, const int32_t q[4], const struct cube_box *point)
{
    const int32_t minus[4] = {-q[0], -q[1], -q[2], -q[3]};
    bool in = cube_holds(cell, point);
    test_require(fibre->contains(cell, q) == in);
    test_require(fibre->contains(cell, minus) == in);
}

/* Every rotation is inside one cell, or on facets of all of the several that hold it. */
START_TEST(tiles_the_rotations)
{
    int32_t rounds = test_rounds(60), shared = 0, once = 0, seams = 0;
    uint64_t state = 1;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell[MOST];
        int32_t count = refine(&state, (int32_t)test_between(&state, 4, MOST), cell), q[4];
        for (int32_t i = 0; i < 400; i++) {
            if (i % 2 == 0)
                any_rotation(&state, q);
            else
                rotation_within(&state, &cell[test_between(&state, 0, count - 1)], i / 2 % 4, q);
            if (i % 16 == 15) /* next to a boundary */
                for (int e = 0; e < 4; e++)
                    q[e] += q[e] < ENTRY && q[e] > -ENTRY ? (int32_t)test_between(&state, -1, 1) : 0;
            struct cube_box point = cube_point(q);
            int32_t held = 0, within = 0, faces = 0;
            for (int32_t k = 0; k < count; k++) {
                check_contains(&cell[k], q, &point);
                held += fibre->contains(&cell[k], q);
                within += cube_holds_within(&cell[k], &point);
                faces |= fibre->contains(&cell[k], q) ? 1 << cell[k].face : 0;
            }
            test_require((held == 1 && within == 1) || (held > 1 && within == 0));
            once += held == 1;
            shared += held > 1;
            seams += (faces & (faces - 1)) != 0;
        }
    }
    ck_assert_int_gt(once, 100 * rounds);
    ck_assert_int_gt(shared, 100 * rounds);
    ck_assert_int_gt(seams, 20 * rounds);
}
END_TEST

START_TEST(nothing_at_infinity)
{
    uint64_t state = 2;
    for (int32_t i = 0; i < 20000; i++) {
        struct cage_cell cell = any_cell(&state);
        int32_t q[4];
        any_rotation(&state, q);
        q[cell.face] = 0;
        for (int32_t e = 0; e < 4; e++) /* and among them 0 */
            q[e] = i % 3 ? q[e] : i % 2 ? 0 : (int32_t)test_between(&state, -1, 1) * (e != cell.face);
        test_require(!fibre->contains(&cell, q));
    }
}
END_TEST

START_TEST(children_share_out_their_parent)
{
    uint64_t state = 3;
    for (int32_t i = 0; i < test_rounds(4000); i++) {
        struct cage_cell cell = any_cell(&state), child[8];
        if (cell.level == fibre->max_level)
            continue;
        int64_t volume = 0, area;
        struct cube_box box = cube_of(&cell);
        for (int32_t k = 0; k < 8; k++) {
            cage_cell_child(&cell, k, &child[k]);
            test_require(child[k].level == cell.level + 1 && child[k].face == cell.face);
            struct cube_box part = cube_of(&child[k]);
            int64_t size = 1;
            for (int32_t e = 0; e < 4; e++) {
                test_require(box.low[e] <= part.low[e] && part.high[e] <= box.high[e]);
                size *= e == cell.face ? 1 : part.high[e] - part.low[e];
            }
            volume += size;
            for (int32_t n = 0; n < k; n++)
                test_require(cube_shared(&child[k], &child[n], &area) < 3);
            test_require(fibre->turn(&child[k]) < fibre->turn(&cell));
            test_require(fibre->touch(&cell, &child[k]) && fibre->touch(&child[k], &cell));
        }
        int64_t width = CUBE_WIDTH >> cell.level;
        test_require(volume == width * width * width);
        for (int32_t n = 0; n < 20; n++) {
            int32_t q[4], held = 0;
            rotation_within(&state, &cell, n % 4, q);
            test_require(fibre->contains(&cell, q));
            for (int32_t k = 0; k < 8; k++)
                held += fibre->contains(&child[k], q);
            test_require(held >= 1);
        }
    }
}
END_TEST

static void check_common(const struct cage_cell *a, const struct cage_cell *b)
{
    int32_t q[4];
    fibre->common(a, b, q);
    struct cube_box point = cube_point(q);
    test_require(cube_holds(a, &point) && cube_holds(b, &point));
    test_require(fibre->contains(a, q) && fibre->contains(b, q));
    for (int e = 0; e < 4; e++)
        test_require(q[e] >= -ENTRY && q[e] <= ENTRY);
}

/* Among cells that tile, touch() is true for the pairs that share a piece of a facet and for no other; the pieces
 * make up all facets. */
START_TEST(knows_its_neighbours)
{
    int32_t rounds = test_rounds(60), across = 0, twice = 0, levels = 0;
    uint64_t state = 4;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell[MOST];
        int32_t count = refine(&state, round == 0 ? fibre->roots : (int32_t)test_between(&state, 5, MOST), cell);
        for (int32_t i = 0; i < count; i++) {
            int64_t facets = 0, area, size = CUBE_WIDTH >> cell[i].level;
            test_require(fibre->touch(&cell[i], &cell[i]));
            for (int32_t k = 0; k < count; k++) {
                int dimension = cube_shared(&cell[i], &cell[k], &area);
                test_require(fibre->touch(&cell[i], &cell[k]) == (dimension >= 2));
                if (i == k || dimension < 2)
                    continue;
                test_require(dimension == 2);
                check_common(&cell[i], &cell[k]);
                facets += area;
                across += cell[i].face != cell[k].face;
                twice += area == 2 * (int64_t)CUBE_WIDTH * CUBE_WIDTH;
                levels += cell[i].face != cell[k].face && abs(cell[i].level - cell[k].level) > 3;
            }
            test_require(facets == 6 * size * size);
        }
    }
    ck_assert_int_gt(across, 100 * rounds);
    ck_assert_int_gt(levels, rounds);
    ck_assert_int_ge(twice, 12); /* two roots meet at two facets */
}
END_TEST

/* The same without boxes: a rotation on a facet is in one more cell, and the two touch. */
START_TEST(facets_have_two_sides)
{
    int32_t rounds = test_rounds(60), looked = 0, across = 0;
    uint64_t state = 5;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell[MOST];
        int32_t count = refine(&state, (int32_t)test_between(&state, 4, MOST), cell);
        for (int32_t n = 0; n < 200; n++) {
            int32_t i = (int32_t)test_between(&state, 0, count - 1), q[4], held = 0, between = 0;
            rotation_within(&state, &cell[i], 1, q);
            struct cube_box point = cube_point(q);
            for (int e = 0; e < 4; e++)
                between += point.low[e] < point.high[e];
            if (between < 2) /* it may be on an edge of another one */
                continue;
            for (int32_t k = 0; k < count; k++) {
                if (!fibre->contains(&cell[k], q))
                    continue;
                held++;
                test_require(fibre->touch(&cell[i], &cell[k]) && fibre->touch(&cell[k], &cell[i]));
                across += cell[k].face != cell[i].face;
            }
            test_require(held == 2);
            looked++;
        }
    }
    ck_assert_int_gt(looked, 100 * rounds);
    ck_assert_int_gt(across, 20 * rounds);
}
END_TEST

/* Any two cells, one inside the other too: most pairs share a rotation or nearly so, and touch() is true from dimension 2 on. */
START_TEST(touches_across_levels)
{
    int32_t seen[2][5] = {{0}};
    uint64_t state = 6;
    int64_t area;
    for (int32_t i = 0; i < test_rounds(400000); i++) {
        int32_t u[4], step = CUBE_WIDTH >> test_between(&state, 0, 11);
        for (int e = 0; e < 4; e++)
            u[e] = step * (int32_t)test_between(&state, 0, CUBE_WIDTH / step);
        u[test_between(&state, 0, 3)] = random_next(&state) & 1 ? 0 : CUBE_WIDTH;
        struct cage_cell a = cell_at(&state, u), b = any_cell(&state);
        int32_t *entry = &u[test_between(&state, 0, 3)];
        if (i % 4 == 1 && *entry > 1 && *entry < CUBE_WIDTH - 1) /* next to each other, at times with a gap between */
            *entry += (int32_t)test_between(&state, -2, 2);
        if (i % 4)
            b = cell_at(&state, u);
        int dimension = cube_shared(&a, &b, &area);
        test_require(i % 4 < 2 || dimension >= 0);
        test_require(fibre->touch(&a, &b) == (dimension >= 2));
        test_require(fibre->touch(&b, &a) == (dimension >= 2));
        if (dimension >= 2)
            check_common(&a, &b);
        seen[a.face != b.face][dimension + 1]++;
    }
    for (int d = 0; d < 5; d++)
        for (int across = 0; across < 2; across++)
            ck_assert_int_ge(seen[across][d], across && d == 4 ? 0 : test_rounds(1000));
}
END_TEST

/* Each cell of a level has 6 neighbours; two faces meet at two facets of the cube, each cut into 4^level. */
START_TEST(levels_have_six_neighbours)
{
    for (int32_t level = 0; level <= 3; level++) {
        int32_t count = fibre->roots << 3 * level, across[4][4] = {{0}};
        struct cage_cell *cell = test_alloc((size_t)count * sizeof *cell);
        for (int32_t i = 0, mask = (1 << level) - 1; i < count; i++) {
            const struct cage_cell made = {level, i >> 3 * level, {i & mask, i >> level & mask, i >> 2 * level & mask}};
            cell[i] = made;
        }
        for (int32_t i = 0; i < count; i++) {
            int32_t neighbours = 0;
            for (int32_t k = 0; k < count; k++) {
                bool touch = i != k && fibre->touch(&cell[i], &cell[k]);
                neighbours += touch;
                across[cell[i].face][cell[k].face] += touch;
            }
            test_require(neighbours == (level == 0 ? 3 : 6));
        }
        for (int f = 0; f < 4; f++)
            for (int g = 0; g < 4; g++)
                ck_assert(f == g || across[f][g] == (level == 0 ? 1 : 2 << 2 * level));
        free(cell);
    }
}
END_TEST

/* A vector of length 1, turned by twice the angle between a and b, moves by 2 sin of that at most. */
static long double moved(const int32_t a[4], const int32_t b[4])
{
    long double wedge = 0, aa = 0, bb = 0;
    for (int e = 0; e < 4; e++) {
        for (int f = 0; f < e; f++) {
            long double minor = (long double)a[e] * b[f] - (long double)a[f] * b[e];
            wedge += minor * minor;
        }
        aa += (long double)a[e] * a[e];
        bb += (long double)b[e] * b[e];
    }
    return 2 * sqrtl(wedge) / sqrtl(aa) / sqrtl(bb);
}

/* q y q* / |q|^2 for y = (0, y) */
static void rotated(const int32_t q[4], const int32_t y[3], long double out[3])
{
    long double w = q[0], v[3] = {q[1], q[2], q[3]}, norm = w * w + v[0] * v[0] + v[1] * v[1] + v[2] * v[2], c[3];
    for (int k = 0; k < 3; k++) /* v x y + w y */
        c[k] = v[(k + 1) % 3] * y[(k + 2) % 3] - v[(k + 2) % 3] * y[(k + 1) % 3] + w * y[k];
    for (int k = 0; k < 3; k++) /* y + 2 v x (v x y + w y) / |q|^2 */
        out[k] = y[k] + 2 * (v[(k + 1) % 3] * c[(k + 2) % 3] - v[(k + 2) % 3] * c[(k + 1) % 3]) / norm;
}

/* turn() bounds what the representative's distance to any rotation of the cell may move, and some corner is that far. */
START_TEST(bounds_what_it_moves)
{
    uint64_t state = 7;
    int32_t rounds = test_rounds(3000);
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell = any_cell(&state);
        int32_t q[4], other[4];
        fibre->representative(&cell, q);
        long double bound = (long double)fibre->turn(&cell) / 2147483648.0L, most = 0;
        for (int32_t i = 0; i < 60; i++) {
            rotation_within(&state, &cell, i % 4, other);
            struct cube_box point = cube_point(other);
            test_require(cube_holds(&cell, &point));
            test_require(moved(q, other) <= bound);
        }
        for (int32_t i = 0; i < 8; i++) {
            corner(&cell, i, other);
            test_require(moved(q, other) <= bound);
            most = moved(q, other) > most ? moved(q, other) : most;
        }
        test_require(bound <= most * (1 + 1e-6L)); /* and is no larger than need be */
    }
}
END_TEST

/* No rotation of the cell takes a ball's centre farther from where the representative takes it than the slices allow for. */
START_TEST(displaces_no_farther)
{
    uint64_t state = 8;
    int32_t rounds = test_rounds(20000), nearly = 0;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell = any_cell(&state);
        int32_t q[4], other[4], at[3], to[3], y[3];
        int64_t limit = random_next(&state) & 1 ? CAGE_REACH_3D : ENTRY, gap = 0;
        for (int k = 0; k < 3; k++)
            y[k] = (int32_t)test_spread(&state, limit);
        fibre->representative(&cell, q);
        rotation_within(&state, &cell, round % 4, other);
        int32_t displacement = cage_displacement(fibre->turn(&cell), cage_length(y));
        long double x[3], z[3], square = 0;
        rotated(q, y, x);
        rotated(other, y, z);
        for (int k = 0; k < 3; k++)
            square += (x[k] - z[k]) * (x[k] - z[k]);
        test_require(sqrtl(square) <= displacement + 1e-9L);
        nearly += displacement > 10 && sqrtl(square) > 0.8L * displacement;

        struct cage_rotation a, b; /* the same with both ends rounded, each off by less than 0.87 */
        cage_rotation_of(q, &a);
        cage_rotation_of(other, &b);
        cage_rotate(&a, y, at);
        cage_rotate(&b, y, to);
        for (int k = 0; k < 3; k++) {
            test_require(fabsl(at[k] - x[k]) < 0.51L && fabsl(to[k] - z[k]) < 0.51L);
            gap += ((int64_t)at[k] - to[k]) * ((int64_t)at[k] - to[k]);
        }
        test_require(sqrtl((long double)gap) < displacement + 2 * 0.87L);
    }
    ck_assert_int_gt(nearly, rounds / 20);
}
END_TEST

/* The corners, and what the distances to them allow for: never less than any rotation of the cell moves a centre, nor
 * more than the turn. */
START_TEST(corners_displace_no_farther)
{
    uint64_t state = 11;
    int32_t rounds = test_rounds(20000), nearly = 0, less = 0;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell = any_cell(&state);
        struct cage_corners corners;
        int32_t q[4], other[4], end[8][4], y[3], found = 0;
        fibre->representative(&cell, q);
        fibre->corners(&cell, end);
        for (int32_t i = 0; i < 8; i++) {
            corner(&cell, i, other);
            for (int32_t k = 0; k < 8; k++)
                found += moved(other, end[k]) == 0;
        }
        test_require(found == 8);
        cage_corners_of(q, end, &corners);
        for (int k = 0; k < 3; k++)
            y[k] = (int32_t)test_spread(&state, random_next(&state) % 4 ? 1200000 : 20);
        int32_t displacement = cage_displacement_within(&corners, y),
                of_turn = cage_displacement(fibre->turn(&cell), cage_length(y));
        long double x[3], z[3], most = 0;
        rotated(q, y, x);
        for (int32_t i = 0; i < 40; i++) {
            long double square = 0;
            if (i < 8)
                corner(&cell, i, other);
            else
                rotation_within(&state, &cell, i % 4, other);
            rotated(other, y, z);
            for (int k = 0; k < 3; k++)
                square += (x[k] - z[k]) * (x[k] - z[k]);
            most = square > most ? square : most;
        }
        most = sqrtl(most);
        test_require(most <= displacement + 1e-9L);
        test_require(displacement <= of_turn + 2);
        nearly += displacement > 100 && most > 0.99L * displacement;
        less += displacement < 0.9L * of_turn;
    }
    ck_assert_int_gt(nearly, rounds / 20);
    ck_assert_int_gt(less, rounds / 20);
}
END_TEST

static struct cage_cell mirrored(uint64_t *state, const struct cage_cell *cell)
{
    struct cage_cell out = {cell->level, (int32_t)test_between(state, 0, 3), {0, 0, 0}};
    int32_t order[3];
    test_shuffle(state, order, 3);
    for (int k = 0; k < 3; k++)
        out.at[k] = random_next(state) & 1 ? cell->at[order[k]] : (1 << cell->level) - 1 - cell->at[order[k]];
    return out;
}

/* The covering radius of each level, as an angle of rotation: a table computed beside the design. Symmetric cells turn alike, so
 * from level 5 on one of 48 is looked at. */
START_TEST(levels_have_their_radius)
{
    static const long double degrees[7] = {120.0L, 71.6L, 39.3L, 20.0L, 10.0L, 5.0L, 2.5L};
    uint64_t state = 9;
    for (int32_t i = 0; i < 2000; i++) {
        struct cage_cell cell = any_cell(&state), other = mirrored(&state, &cell);
        test_require(fibre->turn(&cell) == fibre->turn(&other));
    }
    for (int32_t level = 0; level < 7; level++) {
        int64_t most = 0, least = INT64_MAX;
        int32_t wide = 1 << level, all = level < 5, low = all ? 0 : wide / 2;
        for (int32_t i = low; i < wide; i++)
            for (int32_t j = low; j < (all ? wide : i + 1); j++)
                for (int32_t k = low; k < (all ? wide : j + 1); k++) {
                    const struct cage_cell cell = {level, (i + j + k) % 4, {i, j, k}};
                    int64_t turn = fibre->turn(&cell);
                    most = turn > most ? turn : most;
                    least = turn < least ? turn : least;
                }
        long double radius = 2 * asinl((long double)most / 4294967296.0L) * 180 / acosl(-1);
        ck_assert_msg(fabsl(radius - degrees[level]) < 0.1L, "level %d: %.4Lf degrees", (int)level, radius);
        ck_assert(most <= 2 * least); /* cells of one level are of nearly one size: that is what the quadratic is for */
    }
}
END_TEST

START_TEST(entries_stay_small)
{
    uint64_t state = 10;
    for (int32_t i = 0; i < 20000; i++) {
        struct cage_cell cell = any_cell(&state);
        int32_t q[4], inner;
        fibre->representative(&cell, q);
        struct cube_box point = cube_point(q), box = cube_of(&cell);
        test_require(fibre->contains(&cell, q) && cube_holds_within(&cell, &point));
        for (int e = 0; e < 4; e++) {
            test_require(q[e] >= -ENTRY && q[e] <= ENTRY);
            inner = box.low[e] + box.high[e]; /* the middle: half of it, which at the last level is no integer */
            test_require(point.low[e] + point.high[e] == inner && point.high[e] - point.low[e] == (inner & 1));
        }
    }
    ck_assert_int_eq(fibre->max_level, CAGE_LEVEL_MAX_3D);
    ck_assert_int_eq(ENTRY, CAGE_QUATERNION_3D);
    ck_assert_int_eq(CUBE_WIDTH, 1 << CAGE_LEVEL_MAX_3D);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("so3");
    TCase *tests = test_case(suite, "so3");
    tcase_add_test(tests, tiles_the_rotations);
    tcase_add_test(tests, nothing_at_infinity);
    tcase_add_test(tests, children_share_out_their_parent);
    tcase_add_test(tests, knows_its_neighbours);
    tcase_add_test(tests, facets_have_two_sides);
    tcase_add_test(tests, touches_across_levels);
    tcase_add_test(tests, levels_have_six_neighbours);
    tcase_add_test(tests, bounds_what_it_moves);
    tcase_add_test(tests, displaces_no_farther);
    tcase_add_test(tests, corners_displace_no_farther);
    tcase_add_test(tests, levels_have_their_radius);
    tcase_add_test(tests, entries_stay_small);
    return test_main(suite);
}
