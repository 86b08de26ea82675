/* paths.c: smoothed paths of known scenes: shorter, without corners, judged by dense sampling, and refused once obstructed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../random.h"
#include "proof.h"
#include "smooth.h"

enum { BETWEEN = 6, GROWN = 40, BENT = 8, TUBE = 1000 };

typedef struct known {
    const char *name, *object, *obstacles, *start, *goal; /* files of examples/; null: the tube */
    int level; /* the finest cells: so coarse that nothing is decided; 0: as ever */
    int32_t side;
} known;

/* The questions of the examples' table (demo.sh, and the screw of its comment) that have a path, the poses named there; and a bar
 * in a tube that has to turn by a quarter from the middle of the first chamber to that of the last. */
static const known scenes[] = {
    { "hall, left to right", "walls/plus", "walls/walls_R4", "170,330,0", "390,300,20", 0, CAGE_SIDE_BOTH },
    { "around the walls", "walls/plus", "walls/walls_R4", "20,250,30", "270,40,0", 0, CAGE_SIDE_BOTH },
    { "chamber to hall", "walls/plus", "walls/walls_R10", "185,195,45", "300,320,45", 0, CAGE_SIDE_BOTH },
    { "cubby to chamber", "walls/plus", "walls/walls_R15", "380,190,45", "185,195,45", 0, CAGE_SIDE_BOTH },
    { "T out of a slot", "hooked_t/t", "hooked_t/slot_wide", "0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "part out of fingers", "grasp/part", "grasp/fingers_open", "0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "key out of a lock", "key/key", "key/lock_open", "0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "guest out of a sieve", "space/guest", "space/sieve", "0,0,0,1,0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "ring beside a link", "space/ring", "space/link", "4,0,0,1,0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "dumbbell out of a hoop", "space/dumbbell_small", "space/hoop", "0,0,0,1,0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "coin out of a bank", "space/coin", "space/bank_wide", "0,0,0,1,0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "mug off a hook", "space/mug", "space/hook", "0,0,0,1,0,0,0", NULL, 0, CAGE_SIDE_OUTER },
    { "peanut", "space/peanut", "space/chambers_wide", "-3,0,0,0.707106781,0,0,0.707106781",
      "3,0,0,0.707106781,0,0.707106781,0", 0, CAGE_SIDE_OUTER },
    { "screw out of a coil", "space/screw", "space/coil", "0,0,0,1,0,0,0", NULL, 0, CAGE_SIDE_BOTH },
    { "bar in a twisted tube", NULL, NULL, "0,0,-0.75,1,0,0,0", "0,0,2.25,0.7071,0,0,0.7071", 0, CAGE_SIDE_BOTH },
};

/* Not decided with cells as coarse as these, but their candidates lead through. */
static const known undecided[] = {
    { "bar in a twisted tube", NULL, NULL, "0,0,-0.75,1,0,0,0", "0,0,2.25,0.7071,0,0,0.7071", 1,
      CAGE_SIDE_BOTH },
    { "peanut", "space/peanut", "space/chambers_wide", "-3,0,0,0.707106781,0,0,0.707106781",
      "3,0,0,0.707106781,0,0.707106781,0", 1, CAGE_SIDE_BOTH },
};

/* And these do not lead through, being closed: what is UNDEFINED has to stay so. */
static const known closed[] = {
    { "T in a slot", "hooked_t/t", "hooked_t/slot_hooked", "0,0,0", NULL, 1, CAGE_SIDE_BOTH },
    { "key in a lock", "key/key", "key/lock_locked", "0,0,0", NULL, 1, CAGE_SIDE_BOTH },
};

static int failures;
static int collided, refused_clear, accepted_clear;

static void expect(int holds, const char *scene, const char *what)
{
    if (!holds) {
        failures++;
        printf("FAIL  %s: %s\n", scene, what);
    }
}

/* ---- the judge: the same contract in long double, from the rows alone ----------------------------------------- */

typedef struct judge {
    const cage_scene *scene;
    const int32_t *pivot;
    const cage_pose *row;
    int32_t rows;
} judge;

static long double row_x(const judge *j, int32_t i, int k) { return j->row[i].x[k]; }

static long double slope(const judge *j, int32_t i, int k)
{
    if (i == 0)
        return row_x(j, 1, k) - row_x(j, 0, k);
    if (i == j->rows - 1)
        return row_x(j, i, k) - row_x(j, i - 1, k);
    return (row_x(j, i + 1, k) - row_x(j, i - 1, k)) / 2;
}

/* Row i and t of the way to the next: Hermite's cubic, and the rotation at a constant rate. */
static void pose_at(const judge *j, int32_t i, long double t, long double x[3], long double q[4])
{
    const int32_t *a = j->row[i].q, *b = j->row[i + 1].q;
    long double first = 0, second = 0, dot = 0, angle, f, g;
    for (int k = 0; k < 3; k++)
        x[k] = (2 * t * t * t - 3 * t * t + 1) * row_x(j, i, k) + (t * t * t - 2 * t * t + t) * slope(j, i, k) +
               (3 * t * t - 2 * t * t * t) * row_x(j, i + 1, k) + (t * t * t - t * t) * slope(j, i + 1, k);
    for (int k = 0; k < 4; k++) {
        first += (long double)a[k] * a[k];
        second += (long double)b[k] * b[k];
        dot += (long double)a[k] * b[k];
    }
    first = sqrtl(first);
    second = sqrtl(second) * (dot < 0 ? -1 : 1);
    angle = acosl(fminl(1, dot / (first * second)));
    f = angle > 1e-9L ? sinl((1 - t) * angle) / sinl(angle) : 1 - t;
    g = angle > 1e-9L ? sinl(t * angle) / sinl(angle) : t;
    for (int k = 0; k < 4; k++)
        q[k] = f * a[k] / first + g * b[k] / second;
}

static long double gap_at(const judge *j, const long double x[3], const long double q[4], int32_t only)
{
    const long double w = q[0], a = q[1], b = q[2], c = q[3];
    const long double m[3][3] = { { w * w + a * a - b * b - c * c, 2 * (a * b - w * c), 2 * (a * c + w * b) },
                                  { 2 * (a * b + w * c), w * w - a * a + b * b - c * c, 2 * (b * c - w * a) },
                                  { 2 * (a * c - w * b), 2 * (b * c + w * a), w * w - a * a - b * b + c * c } };
    const cage_shape *object = &j->scene->object, *obstacles = &j->scene->obstacles;
    long double least = INFINITY;
    for (int32_t i = 0; i < object->outer_count; i++) {
        const cage_ball *y = &object->outer[i];
        const long double v[3] = { y->x - j->pivot[0], y->y - j->pivot[1], y->z - j->pivot[2] };
        for (int32_t o = only < 0 ? 0 : only; o < (only < 0 ? obstacles->outer_count : only + 1); o++) {
            const cage_ball *z = &obstacles->outer[o];
            const long double centre[3] = { z->x, z->y, z->z };
            long double square = 0;
            for (int k = 0; k < 3; k++) {
                const long double d = x[k] + m[k][0] * v[0] + m[k][1] * v[1] + m[k][2] * v[2] - centre[k];
                square += d * d;
            }
            least = fminl(least, sqrtl(square) - z->r - y->r);
        }
    }
    return least;
}

/* The least gap of the whole motion, looked at so often between rows; `only`: to that obstacle, -1: to any. */
static long double least_gap(const judge *j, int32_t only)
{
    long double least = INFINITY, x[3], q[4];
    for (int32_t i = 0; i + 1 < j->rows; i++)
        for (int n = 0; n <= BETWEEN; n++) {
            pose_at(j, i, (long double)n / BETWEEN, x, q);
            least = fminl(least, gap_at(j, x, q, only));
        }
    return least;
}

/* The largest turn of the direction of motion from one row to the next, among steps long enough to have one, in degrees. */
static double sharpest(const judge *j)
{
    double most = 0, longest = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int32_t i = 1; i + 1 < j->rows; i++) {
            double a = 0, b = 0, dot = 0;
            for (int k = 0; k < 3; k++) {
                const double u = (double)(row_x(j, i, k) - row_x(j, i - 1, k)), v = (double)(row_x(j, i + 1, k) - row_x(j, i, k));
                a += u * u;
                b += v * v;
                dot += u * v;
            }
            longest = fmax(longest, sqrt(a));
            if (pass == 1 && sqrt(a) > longest / 10 && sqrt(b) > longest / 10)
                most = fmax(most, acos(fmin(1, dot / sqrt(a * b))) * 180 / acos(-1.0));
        }
    return most;
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

static void add_ball(host_balls *balls, double x, double y, double z, double r)
{
    const host_ball ball = { { x, y, z }, r };
    if (balls->ball == NULL)
        balls->ball = calloc(TUBE, sizeof ball);
    if (balls->ball == NULL || balls->count == TUBE)
        exit(2);
    balls->dim = 3;
    balls->ball[balls->count++] = ball;
}

/* A square tube along z, closed at both ends, with two walls in it: the slot of the first lies along x, that of the second
 * along y. A bar wider than the slots are high has to turn on its way. */
static void make_tube(host_query *query)
{
    for (int i = -2; i <= 2; i++)
        add_ball(&query->object, 0.3 * i, 0, 0, 0.18);
    for (int z = -3; z <= 6; z++)
        for (int u = -3; u <= 3; u++)
            for (int v = -3; v <= 3; v++)
                if (abs(u) == 3 || abs(v) == 3 || z == -3 || z == 6 || (z == 0 && abs(v) > 1) || (z == 3 && abs(u) > 1))
                    add_ball(&query->obstacles, 0.5 * u, 0.5 * v, 0.5 * z, 0.36);
}

static int read_scene(const known *scene, const char *examples, host_query *query, host_grid *grid, host_error *error)
{
    char file[512];
    int code = host_parse_pose(scene->start, &query->start, error);
    query->has_goal = scene->goal != NULL;
    if (code == HOST_OK && query->has_goal)
        code = host_parse_pose(scene->goal, &query->goal, error);
    if (scene->object == NULL) {
        make_tube(query);
    } else {
        (void)snprintf(file, sizeof file, "%s/%s.xyzr", examples, scene->object);
        if (code == HOST_OK)
            code = host_read_balls(file, &query->object, error);
        (void)snprintf(file, sizeof file, "%s/%s.xyzr", examples, scene->obstacles);
        if (code == HOST_OK)
            code = host_read_balls(file, &query->obstacles, error);
    }
    if (code == HOST_OK)
        code = host_agree_on_dimension(query, error);
    return code == HOST_OK ? host_to_grid(query, 0, grid, error) : code;
}

/* ---- mutations ------------------------------------------------------------------------------------------------------ */

static void judge_one(const char *name, int answer, long double gap)
{
    collided += gap < -1;
    accepted_clear += gap > 1 && answer == 1;
    refused_clear += gap > 1 && answer == 0;
    expect(!(answer == 1 && gap < -1), name, "a path that collides is accepted");
    expect(answer >= 0, name, "memory");
}

/* One obstacle grows until it stands in the way, or nearly; or a few rows go astray. */
static void mutate(const char *name, const host_answer *answer, const host_way *way, uint64_t *rng)
{
    host_grid grid = *answer->grid;
    host_answer other = *answer;
    judge j = { &grid.scene, answer->result->pivot, way->pose, way->count };
    const int32_t count = grid.scene.obstacles.outer_count;
    cage_ball *ball = malloc((size_t)count * sizeof *ball);
    cage_pose *row = malloc((size_t)way->count * sizeof *row);
    double unused;
    if (ball == NULL || row == NULL)
        exit(2);
    other.grid = &grid;
    for (int n = 0; n < GROWN; n++) {
        const int32_t o = (int32_t)(random_next(rng) % (uint64_t)count);
        memcpy(ball, answer->grid->scene.obstacles.outer, (size_t)count * sizeof *ball);
        grid.scene.obstacles.outer = ball;
        const long double gap = least_gap(&j, o);
        const long double by = gap + (n % 2 ? 1 : -1) * (2 + (long double)(random_next(rng) % 5000));
        if (!(fabsl(by) < 1e8L) || ball[o].r + by < 0)
            continue;
        ball[o].r += (int32_t)by;
        if (cage_scene_check(&grid.scene) == CAGE_OK)
            judge_one(name, way_certify(&other, way->pose, way->count, &unused), least_gap(&j, o));
    }
    grid = *answer->grid;
    j.row = row;
    for (int n = 0; n < BENT; n++) {
        const int32_t at = 2 + (int32_t)(random_next(rng) % (uint64_t)(way->count - 4));
        const double by = way_radius(answer) * pow(0.5, n);
        memcpy(row, way->pose, (size_t)way->count * sizeof *row);
        for (int k = 0; k < answer->query->dim; k++)
            row[at].x[k] += (int32_t)(by * (2 * random_unit(rng) - 1));
        const int answered = way_certify(&other, row, way->count, &unused); /* before the judge: it may take long */
        judge_one(name, answered, least_gap(&j, -1));
    }
    free(ball);
    free(row);
}

/* ---- all of it ------------------------------------------------------------------------------------------------------- */

/* Is the path of this search written down, and not yet shortened? */
static int is_raw(const struct cage_proof *search)
{
    return search != NULL && search->path != NULL && search->path_side == CAGE_OUTER && search->path_count > 0 &&
           search->leg == NULL;
}

/* A decomposable path as the search found it, before the core shortens it. */
typedef struct raw_path {
    double length, direct; /* direct: of a straight leg from its start to its end */
    int32_t count;
} raw_path;

static int32_t prove(host_answer *answer, void *block, size_t bytes, raw_path *raw)
{
    const host_grid *grid = answer->grid;
    int32_t state = cage_prove_begin(&answer->proof, &grid->scene, &grid->start, answer->query->has_goal ? &grid->goal : NULL,
                                     answer->limits, block, bytes);
    memset(raw, 0, sizeof *raw);
    while (state == 0) {
        const struct cage_proof *first = answer->proof, *with = is_raw(first) ? first : first->second;
        answer->result = cage_prove_result(answer->proof);
        if (raw->count == 0 && is_raw(with)) {
            raw->length = way_length(with->path, with->path_count, way_radius(answer));
            raw->count = with->path_count;
            const cage_pose ends[2] = { with->path[0], with->path[raw->count - 1] };
            raw->direct = way_length(ends, 2, way_radius(answer));
        }
        state = cage_prove_run(answer->proof, 1);
    }
    answer->result = cage_prove_result(answer->proof);
    return state;
}

/* Smoothed paths, each against the raw one, and against that one shortened. Where the raw one is straight there is none shorter:
 * those do not count. */
typedef struct tally {
    int scenes, straight;
    double raw, found;
} tally;

/* A question and its answer. */
typedef struct asked {
    host_query query;
    host_grid grid;
    host_answer answer;
    host_way way;
    cage_limits limits;
} asked;

/* The scene's question, with the usual limits. */
static void ask(const known *scene, const char *examples, asked *a)
{
    host_error error;
    memset(a, 0, sizeof *a);
    if (read_scene(scene, examples, &a->query, &a->grid, &error) != HOST_OK) {
        printf("%s: %s\n", scene->name, error.text);
        exit(2);
    }
    cage_limits_default(&a->limits, a->query.dim);
    a->answer.query = &a->query;
    a->answer.grid = &a->grid;
    a->answer.limits = &a->limits;
}

static void forget(asked *a)
{
    host_free_way(&a->way);
    host_free_grid(&a->grid);
    host_free_balls(&a->query.object);
    host_free_balls(&a->query.obstacles);
}

static void run(const known *scene, const char *examples, void *block, size_t bytes, uint64_t *rng, tally *sum)
{
    asked a;
    host_error error;
    raw_path raw;
    double before;
    ask(scene, examples, &a);
    a.limits.side = scene->side;
    before = host_now();
    expect(prove(&a.answer, block, bytes, &raw) == 1 && a.answer.result->path_count > 0, scene->name, "no path was found");
    if (a.answer.result->path_count > 0) {
        const double proved = host_now() - before;
        expect(host_smooth(&a.answer, a.answer.result->path, a.answer.result->path_count, 1, &a.way, &error) == HOST_OK,
               scene->name, "host_smooth");
        const judge j = { &a.grid.scene, a.answer.result->pivot, a.way.pose, a.way.count };
        expect(a.way.smooth, scene->name, "not smoothed");
        if (a.way.smooth) {
            const long double gap = least_gap(&j, -1);
            const double turn = sharpest(&j);
            const double ratio = a.way.length / raw.length, found = a.way.length / a.way.found_length;
            const int straight = raw.length < raw.direct * (1 + 1e-6);
            expect(raw.count > 1 && raw.length > 0.999999 * a.way.found_length, scene->name, "the raw path was not seen");
            expect(straight || raw.count > 2, scene->name, "longer than straight with one leg");
            expect(a.way.length > raw.direct * (1 - 1e-6), scene->name, "shorter than a straight leg");
            sum->scenes += !straight;
            sum->straight += straight;
            sum->raw += straight ? 0 : ratio;
            sum->found += straight ? 0 : found;
            expect(gap > -1e-3L, scene->name, "the judge finds a collision");
            expect(turn < 30, scene->name, "it has a corner");
            printf("      %-22s %3d raw poses, %3d rows, length %.3f of raw, %.3f of shortened, gap %.3Lg units, turns %.1f "
                   "degrees a row; %.1f + %.1f s\n", scene->name, (int)raw.count, (int)a.way.count, ratio, found, gap, turn,
                   proved, host_now() - before - proved);
            mutate(scene->name, &a.answer, &a.way, rng);
        }
    }
    forget(&a);
}

/* What a candidate is: a decomposable way from start to goal through the steps that it names, on which a ball is no deeper in an
 * obstacle than it moves within a cell, twice: from the middle to the rotation, and by how much it was made smaller. */
static void judge_candidate(const known *scene, const host_answer *answer, const host_candidate *c)
{
    static const double angle[] = { 120, 71.6, 39.3, 20 }; /* of cells in space, by level: from the middle, at most */
    const judge j = { &answer->grid->scene, answer->result->pivot, c->pose, c->count };
    const double half = (answer->query->dim == 2 ? 90.0 / (1 << scene->level) : angle[scene->level]) / 360 * acos(-1.0);
    const long double most = 2 * 2 * sin(half) * way_radius(answer) + 8;
    double worst = 0;
    expect(c->steps > 0 && c->step[0].level == -1 && c->step[0].pose == 0, scene->name, "the first step is the start's");
    for (int32_t i = 0; i < c->steps; i++) {
        const int32_t end = i + 1 < c->steps ? c->step[i + 1].pose : c->count;
        expect(c->step[i].pose < end && end <= c->count, scene->name, "steps follow each other");
        expect(c->step[i].level <= scene->level, scene->name, "no finer than allowed");
    }
    for (int32_t i = 0; i + 1 < c->count; i++) {
        const cage_pose *a = &c->pose[i], *b = &c->pose[i + 1];
        expect(memcmp(a->x, b->x, sizeof a->x) == 0 || memcmp(a->q, b->q, sizeof a->q) == 0, scene->name, "it is decomposable");
    }
    expect(-least_gap(&j, -1) < most, scene->name, "deeper than cells explain");
    for (int32_t i = 0; i < c->places; i++)
        worst = fmax(worst, c->place[i].depth);
    printf("      %-22s candidate of %d steps, %d poses, colliding at %d places, by %.3g of the radius at most\n", scene->name,
           (int)c->steps, (int)c->count, (int)c->places, worst / way_radius(answer));
}

/* Asked with cells so coarse that the answer is UNDEFINED: does the candidate become a path? */
static void try_candidate(const known *scene, const char *examples, void *block, size_t bytes, int leads)
{
    asked a;
    host_error error;
    host_candidate candidate;
    raw_path raw;
    ask(scene, examples, &a);
    a.limits.max_level = scene->level;
    expect(prove(&a.answer, block, bytes, &raw) == 1 && a.answer.result->verdict == CAGE_UNDEFINED, scene->name, "not UNDEFINED");
    expect(host_find_candidate(&a.answer, &candidate, &error) == HOST_OK && candidate.count > 1, scene->name, "no candidate");
    if (candidate.count > 1) {
        expect(host_look_at_candidate(&a.answer, &candidate, &error) == HOST_OK, scene->name, "memory");
        judge_candidate(scene, &a.answer, &candidate);
        expect(host_smooth(&a.answer, candidate.pose, candidate.count, 0, &a.way, &error) == HOST_OK, scene->name, "host_smooth");
        expect((a.way.count > 0) == leads, scene->name, leads ? "the candidate was not certified" : "a closed way was certified");
        if (a.way.count > 0) {
            const judge j = { &a.grid.scene, a.answer.result->pivot, a.way.pose, a.way.count };
            expect(least_gap(&j, -1) > -1e-3L, scene->name, "the judge finds a collision");
            expect(cage_path_check(&a.grid.scene, &a.grid.start, a.query.has_goal ? &a.grid.goal : NULL, a.answer.result->pivot,
                                   a.way.pose, a.way.count) == 1, scene->name, "the check refuses it");
        }
    }
    host_free_candidate(&candidate);
    forget(&a);
}

int main(int argc, char **argv)
{
    const size_t bytes = (size_t)1 << 30;
    const int count = (int)(sizeof scenes / sizeof scenes[0]);
    void *block = malloc(bytes);
    uint64_t rng = 7;
    tally sum = { 0, 0, 0, 0 };
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (block == NULL)
        return 2;
    for (int i = 0; i < count; i++)
        run(&scenes[i], argc > 1 ? argv[1] : "examples", block, bytes, &rng, &sum);
    for (size_t i = 0; i < sizeof undecided / sizeof undecided[0]; i++)
        try_candidate(&undecided[i], argc > 1 ? argv[1] : "examples", block, bytes, 1);
    for (size_t i = 0; i < sizeof closed / sizeof closed[0]; i++)
        try_candidate(&closed[i], argc > 1 ? argv[1] : "examples", block, bytes, 0);
    free(block);
    printf("      %d scenes: on average %.3f of the raw path, %.3f of the shortened one; %d more are straight\n", sum.scenes,
           sum.raw / sum.scenes, sum.found / sum.scenes, sum.straight);
    printf("      mutations: %d collide, %d clear accepted, %d clear refused\n", collided, accepted_clear, refused_clear);
    expect(sum.scenes >= 10 && sum.raw / sum.scenes <= 0.7, "all", "not 30 % shorter on average");
    expect(collided >= 200, "all", "fewer than 200 mutations collide");
    expect(accepted_clear >= 20, "all", "hardly a mutation is accepted");
    return failures != 0;
}
