/* test_chart.c: charts, read by a reader of their own, against the slices that they were made from. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ballsets.h"
#include "chart.h"
#include "fibre.h"
#include "pockets.h"
#include "scenes.h"
#include "scenes_space.h"

enum { ARENA = 64 << 20, PAIRS = 200, RANDOM_POINTS = 200, EXHAUSTIVE = 20000 };

static unsigned char *block; /* ARENA bytes, never cleared */

/* ---- a reader, written from the format alone ------------------------------------------------------------ */

__extension__ typedef __int128 wide;

struct reader {
    const uint32_t *word;
    int32_t words;
    int32_t dim;
    int32_t regions;
};

static uint32_t word_at(const struct reader *r, uint32_t at)
{
    test_require(at < (uint32_t)r->words);
    return r->word[at];
}

static int32_t signed_at(const struct reader *r, uint32_t at) { return (int32_t)word_at(r, at); }

static void place_at(const struct reader *r, uint32_t at, int64_t out[3])
{
    const int32_t reach = r->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D; /* no centre is beyond: sentinels are not told */
    for (uint32_t k = 0; k < 3; k++) {
        out[k] = k < (uint32_t)r->dim ? signed_at(r, at + k) : 0;
        test_require(llabs(out[k]) <= reach);
    }
}

static bool ball_holds(const struct reader *r, uint32_t at, const int32_t p[3])
{
    int64_t centre[3], radius = signed_at(r, at + (uint32_t)r->dim), square = 0;
    place_at(r, at, centre);
    test_require(radius >= 0);
    for (int k = 0; k < 3; k++)
        square += (p[k] - centre[k]) * (p[k] - centre[k]);
    return square <= radius * radius;
}

static int sign_of(int32_t dim, int64_t v[4][3])
{
    wide d[3][3], value;
    for (int i = 0; i < dim; i++)
        for (int k = 0; k < 3; k++)
            d[i][k] = v[i + 1][k] - v[0][k];
    if (dim == 2)
        value = d[0][0] * d[1][1] - d[0][1] * d[1][0];
    else
        value = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    return (value > 0) - (value < 0);
}

/* Does the closed simplex hold p? With p in place of any vertex it is turned as before, or flat. */
static bool simplex_holds(const struct reader *r, uint32_t vertices, const int32_t p[3])
{
    int64_t v[4][3], saved[3];
    for (uint32_t i = 0; i <= (uint32_t)r->dim; i++)
        place_at(r, word_at(r, vertices + i), v[i]);
    int whole = sign_of(r->dim, v);
    bool holds = true;
    test_require(whole != 0);
    for (int i = 0; i <= r->dim; i++) {
        memcpy(saved, v[i], sizeof saved);
        for (int k = 0; k < 3; k++)
            v[i][k] = p[k];
        holds = holds && sign_of(r->dim, v) != -whole;
        memcpy(v[i], saved, sizeof saved);
    }
    return holds;
}

static int32_t component_of(const struct reader *r, uint32_t at)
{
    int32_t component = signed_at(r, at);
    test_require(component >= CAGE_COVERED && component < r->regions);
    return component;
}

static int32_t read_list(const struct reader *r, uint32_t list, const int32_t p[3])
{
    uint32_t balls = word_at(r, list) & 65535, simplices = word_at(r, list) >> 16, at = list + 2 + balls;
    test_require(balls <= (r->dim == 2 ? CAGE_CHART_BALLS_2D : CAGE_CHART_BALLS_3D) && simplices <= CAGE_CHART_SIMPLICES);
    int32_t component = component_of(r, list + 1);
    bool held = false;
    for (uint32_t i = 0; i < balls; i++)
        if (ball_holds(r, word_at(r, list + 2 + i), p))
            return CAGE_COVERED;
    for (uint32_t i = 0; i < simplices; i++, at += (uint32_t)r->dim + 2)
        if (simplex_holds(r, at + 1, p)) {
            test_require(!held || component == component_of(r, at)); /* on a common facet: the same */
            component = component_of(r, at);
            held = true;
        }
    return component;
}

static int32_t read_chart(const struct reader *r, const int32_t p[3], int32_t *lists)
{
    int64_t low[3], size = (int64_t)1 << word_at(r, CAGE_CHART_BITS);
    for (uint32_t k = 0; k < 3; k++)
        low[k] = signed_at(r, CAGE_CHART_LOW + k);
    for (uint32_t k = 0; k < (uint32_t)r->dim; k++)
        if (p[k] < low[k] || p[k] > signed_at(r, CAGE_CHART_HIGH + k))
            return CAGE_OUTSIDE;
    uint32_t entry = word_at(r, CAGE_CHART_ROOT);
    while ((entry & 3) == CAGE_CHART_SPLIT) {
        uint32_t half = 0;
        test_require(size > 1);
        size /= 2;
        for (int k = 0; k < r->dim; k++)
            if (p[k] >= low[k] + size) {
                low[k] += size;
                half |= 1u << k;
            }
        entry = word_at(r, (entry >> 2) + half);
    }
    test_require((entry & 3) == CAGE_CHART_LABEL || (entry & 3) == CAGE_CHART_LIST);
    if ((entry & 3) == CAGE_CHART_LABEL) {
        test_require(entry >> 2 <= (uint32_t)r->regions);
        return (int32_t)(entry >> 2) - 1;
    }
    ++*lists;
    return read_list(r, entry >> 2, p);
}

/* ---- points --------------------------------------------------------------------------------------------- */

/* A chart beside its slice, and what was seen of both. */
struct pair {
    const struct cage_slice *slice;
    struct reader reader;
    uint64_t state;
    const char *wrong; /* null, or what differs */
    char text[120];
    int32_t low[3], high[3]; /* the bounding box as the chart has it */
};

static struct {
    int64_t points, covered, bounded, phantoms;
    int32_t charts, lists;
} seen;

static void ask(struct pair *pair, int64_t x, int64_t y, int64_t z)
{
    const int32_t reach = pair->reader.dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    if (pair->wrong || llabs(x) > reach || llabs(y) > reach || llabs(z) > reach)
        return;
    const int32_t p[3] = {(int32_t)x, (int32_t)y, pair->reader.dim == 3 ? (int32_t)z : 0};
    int32_t said = read_chart(&pair->reader, p, &seen.lists), is = cage_slice_locate(pair->slice, p);
    seen.points++;
    seen.covered += is == CAGE_COVERED;
    seen.bounded += is > CAGE_OUTSIDE;
    if (said == is)
        return;
    (void)snprintf(pair->text, sizeof pair->text, "(%d %d %d) is in %d, not in %d", (int)p[0], (int)p[1], (int)p[2], (int)is,
                   (int)said);
    pair->wrong = pair->text;
}

static int64_t draw(struct pair *pair, int64_t low, int64_t high) { return test_between(&pair->state, low, high); }

static void ask_near(struct pair *pair, const double at[3], int64_t by)
{
    int64_t p[3];
    for (int k = 0; k < 3; k++)
        p[k] = llround(at[k]) + draw(pair, -by, by);
    ask(pair, p[0], p[1], p[2]);
}

static const struct cage_site *site(const struct pair *pair, int32_t i)
{
    return &pair->slice->t.site[pair->slice->t.dim + 1 + i];
}

static int32_t sites(const struct pair *pair) { return pair->slice->t.sites - pair->slice->t.dim - 1; }

/* 0 to 2 units before and behind the surface, on the axes and in any direction. */
static void ask_surfaces(struct pair *pair)
{
    for (int32_t i = 0; i < sites(pair); i++) {
        const struct cage_site *s = site(pair, i);
        for (int64_t away = s->r - 2; away <= (int64_t)s->r + 2; away++) {
            int64_t end = draw(pair, 0, 1) ? away : -away;
            double to[3], size = 0;
            ask(pair, s->x + end, s->y, s->z);
            ask(pair, s->x, s->y - end, s->z);
            if (pair->reader.dim == 3)
                ask(pair, s->x, s->y, s->z + end);
            for (int k = 0; k < 3; k++) {
                to[k] = k < pair->reader.dim ? (double)draw(pair, -1000, 1000) : 0;
                size += to[k] * to[k];
            }
            size = size > 0 ? sqrt(size) : 1;
            const double at[3] = {s->x + to[0] * (double)away / size, s->y + to[1] * (double)away / size,
                                  s->z + to[2] * (double)away / size};
            ask_near(pair, at, 0);
        }
    }
}

/* Where two spheres cross, or touch: a point of the circle, and its neighbours. */
static void ask_crossing(struct pair *pair, const struct cage_site *a, const struct cage_site *b)
{
    double d[3] = {(double)b->x - a->x, (double)b->y - a->y, (double)b->z - a->z}, n[3] = {0, 0, 0}, size = 0;
    double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], along, across;
    if (square == 0)
        return;
    along = (square + (double)a->r * a->r - (double)b->r * b->r) / (2 * square);
    across = (double)a->r * a->r - along * along * square;
    if (across < -1e-9 * square)
        return;
    const double any[3] = {(double)draw(pair, -9, 9), (double)draw(pair, -9, 9), (double)draw(pair, -9, 9)};
    if (pair->reader.dim == 2) {
        n[0] = -d[1];
        n[1] = d[0];
    } else
        for (int k = 0; k < 3; k++)
            n[k] = d[(k + 1) % 3] * any[(k + 2) % 3] - d[(k + 2) % 3] * any[(k + 1) % 3];
    for (int k = 0; k < 3; k++)
        size += n[k] * n[k];
    across = size > 0 && across > 0 ? sqrt(across / size) : 0;
    for (int end = -1; end <= 1; end += 2) {
        const double at[3] = {a->x + along * d[0] + end * across * n[0], a->y + along * d[1] + end * across * n[1],
                              a->z + along * d[2] + end * across * n[2]};
        for (int64_t by = 0; by <= 2; by++)
            ask_near(pair, at, by);
    }
}

/* Around the orthocentre and the middle of every simplex: in every component, also those narrower than the grid, and in what
 * only looks free as balls were left out (see prune.h). */
static void ask_simplices(struct pair *pair)
{
    const struct cage_triangulation *t = &pair->slice->t;
    bool all = pair->slice->balls == sites(pair);
    for (int32_t s = 0; s < t->simplices; s++) {
        const struct cage_site *v[4];
        struct cage_centre centre;
        int32_t at[3];
        if (cage_simplex_outer(t, s))
            continue;
        cage_simplex_sites(t, s, v);
        double middle[3] = {0, 0, 0};
        for (int i = 0; i <= t->dim; i++) {
            middle[0] += (double)v[i]->x / (t->dim + 1);
            middle[1] += (double)v[i]->y / (t->dim + 1);
            middle[2] += (double)v[i]->z / (t->dim + 1);
        }
        bool phantom = !all && pair->slice->label[s] == CAGE_COVERED && cage_component_free(t, s);
        seen.phantoms += phantom;
        ask_near(pair, middle, phantom ? 2 : 0);
        cage_orthocentre(t->dim, v, &centre);
        if (!cage_centre_point(t->dim, &centre, at))
            continue;
        const double deep[3] = {at[0], at[1], at[2]};
        for (int64_t by = 0; by <= 2; by++)
            ask_near(pair, deep, by);
    }
}

/* Corners of the bounding box, one unit within and beyond, and points on the borders of the tree's boxes. */
static void ask_box(struct pair *pair)
{
    int32_t bits = (int32_t)pair->reader.word[CAGE_CHART_BITS];
    for (int corner = 0; corner < 8; corner++)
        for (int64_t by = -1; by <= 1; by++) {
            int64_t p[3];
            for (int k = 0; k < 3; k++)
                p[k] = corner >> k & 1 ? pair->high[k] + by : pair->low[k] - by;
            ask(pair, p[0], p[1], p[2]);
        }
    for (int i = 0; i < RANDOM_POINTS; i++) {
        int64_t p[3];
        for (int k = 0; k < 3; k++) {
            int64_t unit = (int64_t)1 << draw(pair, 0, bits), wide_box = (int64_t)pair->high[k] - pair->low[k];
            p[k] = draw(pair, pair->low[k], (int64_t)pair->high[k] + (wide_box < 0));
            if (draw(pair, 0, 1))
                p[k] = pair->low[k] + (p[k] - pair->low[k]) / unit * unit - draw(pair, 0, 1);
        }
        ask(pair, p[0], p[1], p[2]);
    }
}

/* Every grid point of a small box, and one beyond. */
static void ask_all(struct pair *pair)
{
    for (int64_t x = (int64_t)pair->low[0] - 1; x <= (int64_t)pair->high[0] + 1; x++)
        for (int64_t y = (int64_t)pair->low[1] - 1; y <= (int64_t)pair->high[1] + 1; y++)
            for (int64_t z = (int64_t)pair->low[2] - 1; z <= (int64_t)pair->high[2] + 1; z++)
                if (pair->reader.dim == 3 || z == 0)
                    ask(pair, x, y, z);
}

/* The corners of the box are those of the balls. */
static void check_box(struct pair *pair)
{
    int64_t low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    for (int32_t i = 0; i < sites(pair); i++) {
        const struct cage_site *s = site(pair, i);
        const int64_t at[3] = {s->x, s->y, s->z};
        for (int k = 0; k < pair->reader.dim; k++) {
            low[k] = i == 0 || at[k] - s->r < low[k] ? at[k] - s->r : low[k];
            high[k] = i == 0 || at[k] + s->r > high[k] ? at[k] + s->r : high[k];
        }
    }
    for (int k = 0; k < pair->reader.dim && sites(pair) > 0; k++)
        test_require(pair->low[k] == low[k] && pair->high[k] == high[k]);
}

/* Null, or where the chart differs from the slice; valid until the next call. */
static const char *compare(struct cage_arena *arena, const struct cage_slice *slice, uint64_t seed)
{
    static struct pair pair;
    struct cage_chart chart;
    ck_assert_int_eq(cage_chart_make(arena, slice, &chart), CAGE_OK);
    uint32_t *word = test_alloc((size_t)chart.words * sizeof *word); /* of its own, so that a read beyond is seen */
    memcpy(word, chart.word, (size_t)chart.words * sizeof *word);
    memset(&pair, 0, sizeof pair);
    pair.slice = slice;
    pair.state = seed;
    const struct reader reader = {word, chart.words, slice->t.dim, slice->regions};
    pair.reader = reader;
    int64_t volume = 1;
    for (uint32_t k = 0; k < 3; k++) {
        pair.low[k] = signed_at(&reader, CAGE_CHART_LOW + k);
        pair.high[k] = signed_at(&reader, CAGE_CHART_HIGH + k);
        volume = volume > EXHAUSTIVE ? volume : volume * ((int64_t)pair.high[k] - pair.low[k] + 1);
    }
    check_box(&pair);
    ask_box(&pair);
    ask_surfaces(&pair);
    ask_simplices(&pair);
    for (int32_t i = 0, last = sites(&pair) - 1; i < PAIRS && last > 0; i++)
        ask_crossing(&pair, site(&pair, (int32_t)draw(&pair, 0, last)), site(&pair, (int32_t)draw(&pair, 0, last)));
    for (int32_t k = 0; k < slice->regions; k++)
        if (slice->region[k].known)
            ask(&pair, slice->region[k].point[0], slice->region[k].point[1], slice->region[k].point[2]);
    if (volume <= EXHAUSTIVE)
        ask_all(&pair);
    seen.charts++;
    free(word);
    return pair.wrong;
}

static void report(const char *what)
{
    printf("chart: %s: %d charts, %lld points, %lld covered, %lld in bounded components, %d by lists, %lld simplices that only "
           "look free\n", what, (int)seen.charts, (long long)seen.points, (long long)seen.covered, (long long)seen.bounded,
           (int)seen.lists, (long long)seen.phantoms);
}

/* ---- slices --------------------------------------------------------------------------------------------- */

/* A cell of a level, its rotations and corners. */
static void choose_cell(uint64_t *state, int32_t dim, int32_t level, struct cage_rotations *out, struct cage_corners *corners)
{
    const struct cage_fibre *fibre = dim == 2 ? &cage_so2 : &cage_so3;
    struct cage_cell cell = {0, (int32_t)test_between(state, 0, fibre->roots - 1), {0, 0, 0}};
    while (cell.level < level) {
        struct cage_cell child;
        cage_cell_child(&cell, (int32_t)test_between(state, 0, fibre->children - 1), &child);
        cell = child;
    }
    fibre->representative(&cell, out->q);
    out->turn = fibre->turn(&cell);
    if (fibre == &cage_so3) {
        int32_t corner[8][4];
        fibre->corners(&cell, corner);
        cage_corners_of(out->q, corner, corners);
    }
}

static void compare_scene(const cage_scene *view, uint64_t seed)
{
    uint64_t state = seed;
    int32_t pivot[3];
    cage_pivot(&view->object, pivot);
    for (int32_t sign = -1; sign <= 1; sign += 2)
        for (int32_t i = 0; i < 2; i++) {
            struct cage_arena arena;
            struct cage_side side;
            struct cage_slice slice;
            struct cage_rotations rotations;
            struct cage_corners corners;
            cage_arena_init(&arena, block, ARENA);
            ck_assert_int_eq(cage_side_make(&arena, view, pivot, sign, &cage_all_shortcuts, &side), CAGE_OK);
            choose_cell(&state, view->dim, (int32_t)test_between(&state, 0, view->dim == 2 ? 9 : 5), &rotations, &corners);
            const struct cage_corners *within = view->dim == 3 ? &corners : NULL;
            ck_assert_int_eq(cage_slice_make_within(&arena, &side, &rotations, within, &slice), CAGE_OK);
            const char *wrong = compare(&arena, &slice, seed);
            ck_assert_msg(!wrong, "dim %d, seed %lu, side %d: %s", (int)view->dim, (unsigned long)seed, (int)sign, wrong);
        }
}

START_TEST(charts_of_plane_scenes)
{
    int32_t rounds = test_rounds(120);
    memset(&seen, 0, sizeof seen);
    for (int32_t seed = 0; seed < rounds; seed++) {
        scene s;
        scene_random((uint64_t)seed + 700000, &s);
        cage_scene view = scene_view(&s);
        compare_scene(&view, (uint64_t)seed + 700000);
    }
    report("the plane");
    ck_assert(seen.bounded > seen.points / 1000 && seen.covered > seen.points / 10 && seen.lists > seen.points / 10);
}
END_TEST

START_TEST(charts_of_space_scenes)
{
    int32_t rounds = test_rounds(40);
    memset(&seen, 0, sizeof seen);
    for (int32_t seed = 0; seed < rounds; seed++) {
        space_scene s;
        space_random((uint64_t)seed + 700000, &s);
        cage_scene view = space_view(&s);
        compare_scene(&view, (uint64_t)seed + 700000);
    }
    report("space");
    ck_assert(seen.bounded > 0 && seen.covered > seen.points / 10 && seen.lists > seen.points / 10);
}
END_TEST

/* Many components next to contact. */
START_TEST(charts_of_pockets)
{
    int32_t dim = 2 + _i, rounds = test_rounds(dim == 2 ? 300 : 100);
    memset(&seen, 0, sizeof seen);
    for (int32_t seed = 0; seed < rounds; seed++)
        for (int32_t i = 0; i < 2; i++) {
            struct pockets p;
            struct cage_arena arena;
            struct cage_side side;
            struct cage_slice slice;
            (seed % 4 == 0 ? pockets_vanish : pockets_make)(dim, (uint64_t)seed, &p);
            cage_arena_init(&arena, block, ARENA);
            pockets_side(&arena, &p, &side);
            ck_assert_int_eq(cage_slice_make(&arena, &side, &p.at[i], &slice), CAGE_OK);
            const char *wrong = compare(&arena, &slice, (uint64_t)seed);
            if (wrong)
                pockets_print(stderr, &p);
            ck_assert_msg(!wrong, "dim %d, seed %d: %s", (int)dim, (int)seed, wrong);
        }
    report(dim == 2 ? "pockets in the plane" : "pockets in space");
    ck_assert(seen.bounded > seen.points / 100);
    ck_assert(seen.phantoms > 0 || dim == 3 || rounds < 600);
}
END_TEST

/* The balls as they are, as one slice: a single object ball that makes up for the slack. */
static void slice_of(struct cage_arena *arena, int32_t dim, const cage_ball *ball, int32_t count, struct cage_slice *out)
{
    static const struct cage_rotations rotations = {{1, 0, 0, 0}, 0};
    static const int32_t reach = 0;
    const cage_ball point = {0, 0, 0, -cage_radius_change(0, -1)};
    const struct cage_side side = {&point, &reach, ball, 1, count, dim, -1, &cage_all_shortcuts, {NULL, NULL, NULL, NULL}};
    ck_assert_int_eq(cage_slice_make(arena, &side, &rotations, out), CAGE_OK);
    ck_assert_int_eq(out->balls, count);
}

static void compare_balls(int32_t dim, const cage_ball *ball, int32_t count, uint64_t seed, const char *what)
{
    struct cage_arena arena;
    struct cage_slice slice;
    cage_arena_init(&arena, block, ARENA);
    slice_of(&arena, dim, ball, count, &slice);
    const char *wrong = compare(&arena, &slice, seed);
    ck_assert_msg(!wrong, "%s, dim %d, %d balls, seed %lu: %s", what, (int)dim, (int)count, (unsigned long)seed, wrong);
}

/* Halved until they fit a scene. */
static void fit(int32_t dim, cage_ball *ball, int32_t count)
{
    static const cage_ball point = {0, 0, 0, 2};
    const cage_scene view = {{&point, &point, 1, 1}, {ball, ball, count, count}, dim};
    while (cage_scene_check(&view) != CAGE_OK)
        for (int32_t i = 0; i < count; i++) {
            ball[i].x /= 2;
            ball[i].y /= 2;
            ball[i].z /= 2;
            ball[i].r /= 2;
        }
}

/* Ties of all kinds, few units wide and as wide as may be. */
START_TEST(charts_of_ball_sets)
{
    enum { MOST = 300 };
    int32_t dim = 2 + _i, rounds = test_rounds(dim == 2 ? 20 : 10);
    memset(&seen, 0, sizeof seen);
    for (int32_t kind = 0; kind < BALLS_KINDS; kind++)
        for (int32_t seed = 0; seed < rounds; seed++) {
            cage_ball ball[MOST];
            uint64_t state = (uint64_t)(seed * BALLS_KINDS + kind);
            int32_t count = (int32_t)test_between(&state, 1, seed % 4 == 0 ? MOST : 30);
            balls_make((enum balls_kind)kind, dim, (uint64_t)seed, count, ball);
            fit(dim, ball, count);
            compare_balls(dim, ball, count, (uint64_t)seed, balls_text((enum balls_kind)kind));
        }
    report(dim == 2 ? "sets of balls in the plane" : "sets of balls in space");
    ck_assert(seen.bounded > 0);
}
END_TEST

/* Equal balls on a lattice that leave a pocket at the middle of each cell, touch there, or just do not. */
START_TEST(charts_of_lattices)
{
    enum { MOST = 512 };
    int32_t dim = 2 + _i, edge = dim == 2 ? 22 : 8, step = test_rounds(20) == 20 ? 1 : 4;
    memset(&seen, 0, sizeof seen);
    for (int32_t half = 2; half <= 40; half += 19)
        for (int32_t r = half; r * r <= dim * half * half + 2 * half; r += step) {
            cage_ball ball[MOST];
            int32_t count = 0;
            for (int32_t i = 0; i < edge * edge * (dim == 3 ? edge : 1); i++) {
                const cage_ball made = {2 * half * (i % edge), 2 * half * (i / edge % edge), 2 * half * (i / edge / edge), r};
                ball[count++] = made;
            }
            compare_balls(dim, ball, count, (uint64_t)r, "lattice");
        }
    ck_assert(seen.bounded > 0 && seen.covered > 0);
}
END_TEST

/* Balls at the corners of a rectangle of 6 by 8 units, of radius 5 units: they meet in its middle, and with a radius any smaller
 * there is one pocket, with or without a point in it. */
START_TEST(pockets_that_just_close)
{
    for (int32_t unit = 1; unit <= 3000000; unit *= 7)
        for (int32_t less = -1; less <= 3; less++) {
            struct cage_arena arena;
            struct cage_slice slice;
            cage_ball ball[5] = {{0, 0, 0, 5 * unit}, {6 * unit, 0, 0, 5 * unit}, {0, 8 * unit, 0, 5 * unit},
                                 {6 * unit, 8 * unit, 0, 5 * unit}, {3 * unit, 4 * unit, 0, 0}};
            for (int32_t i = 0; i < 4; i++)
                ball[i].r -= less;
            for (int32_t count = 3; count <= 5; count++) {
                compare_balls(2, ball, count, (uint64_t)unit, "a pocket that just closes");
                if (ball[0].r < 4 * unit)
                    continue; /* the long edges are open */
                cage_arena_init(&arena, block, ARENA);
                slice_of(&arena, 2, ball, count < 4 ? 4 : count, &slice);
                ck_assert_int_eq(slice.regions, less > 0 ? 2 : 1);
            }
        }
}
END_TEST

/* The same ball many times is one: all of them matter alike everywhere, and none need be told twice. */
START_TEST(coincident_balls_count_once)
{
    enum { MANY = 400 };
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int32_t r = 100; r <= 1000000; r *= 100) {
            cage_ball ball[MANY];
            struct cage_arena arena;
            struct cage_slice slice;
            struct cage_chart one, chart;
            for (int32_t i = 0; i < MANY; i++) {
                const cage_ball made = {3 * r, -r, 0, r};
                ball[i] = made;
            }
            cage_arena_init(&arena, block, ARENA);
            slice_of(&arena, dim, ball, 1, &slice);
            ck_assert_int_eq(cage_chart_make(&arena, &slice, &one), CAGE_OK);
            for (int32_t count = 2; count <= MANY; count *= 2) {
                cage_arena_init(&arena, block, ARENA);
                slice_of(&arena, dim, ball, count, &slice);
                ck_assert_int_eq(cage_chart_make(&arena, &slice, &chart), CAGE_OK);
                ck_assert_int_le(chart.words, one.words + count * (dim + 2)); /* at most each ball once, in one list */
                compare_balls(dim, ball, count, 4, "coincident");
            }
        }
}
END_TEST

START_TEST(charts_of_few_balls)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        const int32_t far_out = dim == 2 ? CAGE_REACH_2D / 2 : CAGE_REACH_3D / 2;
        const cage_ball nested[4] = {{0, 0, 0, 9}, {1, 1, 0, 3}, {2, 0, 0, 7}, {0, 0, 0, 9}};
        const cage_ball apart[3] = {{far_out, far_out, 0, 0}, {-far_out, far_out, 0, 1}, {0, -far_out, 0, 2}};
        for (int32_t count = 0; count <= 4; count++)
            compare_balls(dim, nested, count, 1, "nested");
        for (int32_t count = 1; count <= 3; count++)
            compare_balls(dim, apart, count, 2, "far apart");
        for (int32_t r = 0; r <= 3; r++)
            for (int32_t count = 1; count <= 3; count++) {
                const cage_ball same[3] = {{-5, 7, 0, r}, {-5, 7, 0, r}, {-5, 7, 0, r}};
                compare_balls(dim, same, count, 3, "coincident");
            }
    }
}
END_TEST

/* ---- memory --------------------------------------------------------------------------------------------- */

/* The same words, or not enough memory and nothing taken; after the first size that will do all will. */
START_TEST(memory_sweep)
{
    enum { TAKEN = 40, CANARY = 64 };
    struct pockets p;
    struct cage_arena arena;
    struct cage_side side;
    struct cage_slice slice;
    struct cage_chart right, chart;
    int32_t enough = 0, failed = 0;
    pockets_make(2 + _i % 2, (uint64_t)_i, &p);
    cage_arena_init(&arena, block, ARENA);
    pockets_side(&arena, &p, &side);
    ck_assert_int_eq(cage_slice_make(&arena, &side, &p.at[0], &slice), CAGE_OK);
    size_t before = arena.used;
    ck_assert_int_eq(cage_chart_make(&arena, &slice, &right), CAGE_OK);
    ck_assert_uint_ge(arena.used, before + (size_t)right.words * sizeof *right.word);
    ck_assert_uint_lt(arena.used, before + (size_t)right.words * sizeof *right.word + CAGE_ALIGN);
    size_t step = test_rounds(10) == 10 ? 8 : 1024;
    for (size_t bytes = TAKEN; bytes < ((size_t)4 << 20) && enough < 20; bytes += step + (bytes >> 10)) {
        unsigned char *memory = test_alloc(bytes + CANARY);
        memset(memory + bytes, 0x5a, CANARY);
        cage_arena_init(&arena, memory, bytes);
        test_require(cage_arena_take(&arena, TAKEN, 1) != NULL);
        int32_t error = cage_chart_make(&arena, &slice, &chart);
        test_require(error == CAGE_OK || error == CAGE_ERROR_MEMORY);
        test_require(arena.peak <= arena.size);
        if (error != CAGE_OK) {
            test_require(enough == 0 && arena.used == TAKEN && arena.needed > arena.size);
            failed++;
        } else {
            test_require(chart.words == right.words);
            test_require(memcmp(chart.word, right.word, (size_t)right.words * sizeof *right.word) == 0);
            test_require((unsigned char *)chart.word == memory + TAKEN);
            enough++;
        }
        for (size_t i = 0; i < CANARY; i++)
            test_require(memory[bytes + i] == 0x5a);
        free(memory);
    }
    ck_assert_int_eq(enough, 20);
    ck_assert_int_gt(failed, 5);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("chart");
    TCase *tests = test_case(suite, "chart");
    block = test_alloc(ARENA);
    tcase_add_test(tests, charts_of_plane_scenes);
    tcase_add_test(tests, charts_of_space_scenes);
    tcase_add_loop_test(tests, charts_of_pockets, 0, 2);
    tcase_add_loop_test(tests, charts_of_ball_sets, 0, 2);
    tcase_add_loop_test(tests, charts_of_lattices, 0, 2);
    tcase_add_test(tests, pockets_that_just_close);
    tcase_add_test(tests, coincident_balls_count_once);
    tcase_add_test(tests, charts_of_few_balls);
    tcase_add_loop_test(tests, memory_sweep, 0, 8);
    int status = test_main(suite);
    free(block);
    return status;
}
