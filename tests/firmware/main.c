/* main.c: the whole line on shared scenes, printed so that every machine prints the same; without heap or files.
 *
 * One line for each proof and each atlas, then the sum of the steps and one hash over every byte of every result; after these
 * what may differ between machines: memory, and instructions where the machine counts them. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cage.h"
#include "counter.h"

struct entry {
    int32_t dim, seed, level; /* level of the atlas, -1: none */
    int32_t objects, obstacles, has_goal;
    const cage_ball *object, *obstacle;
    cage_pose start, goal;
};

#include "table.h"

enum { BLOCK = 5 << 20, ATLAS = 1 << 20, ENTRIES = sizeof table / sizeof *table };

static union {
    uint64_t align;
    unsigned char byte[BLOCK];
} block;
static unsigned char atlas_bytes[ATLAS];

static uint64_t all_hash, all_steps, worst_step, worst_balls, most_bytes;

/* ---- hash and print ------------------------------------------------------------------------------------- */

/* FNV-1a, of 64 bits. */
static uint64_t hash_byte(uint64_t hash, uint32_t byte)
{
    return (hash ^ byte) * 1099511628211u;
}

static void add(uint64_t *hash, int64_t value)
{
    for (uint32_t i = 0; i < 8; i++)
        *hash = hash_byte(*hash, (uint32_t)((uint64_t)value >> 8 * i) & 255);
}

static void add_pose(uint64_t *hash, const cage_pose *pose)
{
    for (int32_t i = 0; i < 3; i++)
        add(hash, pose->x[i]);
    for (int32_t i = 0; i < 4; i++)
        add(hash, pose->q[i]);
}

static void put(const char *text)
{
    for (; *text; text++)
        putchar(*text);
}

static void put_number(uint64_t value)
{
    char digit[24], *at = digit + sizeof digit - 1;
    *at = 0;
    do
        *--at = (char)('0' + value % 10);
    while ((value /= 10) > 0);
    put(at);
}

static void put_hash(uint64_t hash)
{
    for (uint32_t i = 0; i < 16; i++)
        putchar("0123456789abcdef"[hash >> (60 - 4 * i) & 15]);
}

static void field(const char *name, uint64_t value)
{
    put(name);
    put_number(value);
}

/* ---- proofs --------------------------------------------------------------------------------------------- */

static uint64_t triangulated(const int64_t inserted[2])
{
    return (uint64_t)inserted[0] + (uint64_t)inserted[1];
}

static void add_result(uint64_t *hash, const cage_result *r)
{
    add(hash, r->verdict);
    add(hash, r->reason);
    add(hash, r->level);
    add(hash, r->cells);
    for (int32_t side = 0; side < 2; side++) {
        add(hash, r->slices[side]);
        add(hash, r->gluings[side]);
        add(hash, r->mixtures[side]);
        add(hash, r->reached[side]);
        add(hash, r->balls[side]);
        add(hash, r->inserted[side]);
    }
    add(hash, r->steps);
    for (int32_t i = 0; i < 3; i++)
        add(hash, r->pivot[i]);
    add(hash, r->path_count);
    for (int32_t i = 0; i < r->path_count; i++)
        add_pose(hash, &r->path[i]);
}

/* A separation once more, by the inner side alone and in the least code: its steps and balls are others. */
static int32_t prove_small(const struct entry *e, const cage_scene *scene, int32_t verdict)
{
    cage_limits limits;
    cage_proof *proof;
    cage_limits_default(&limits, e->dim);
    limits.side = CAGE_SIDE_INNER;
    limits.max_cells = e->dim == 2 ? 1024 : 8192;
    int32_t state = cage_prove_begin_small(&proof, scene, &e->start, e->has_goal ? &e->goal : NULL, &limits, block.byte, BLOCK);
    while (state == 0)
        state = cage_prove_run_inner(proof, 1);
    if (state < 0 || cage_prove_result(proof)->verdict != verdict) {
        put("the least code: ");
        put(state < 0 ? cage_error_text(state) : cage_verdict_text(cage_prove_result(proof)->verdict));
        put("\n");
        return 1;
    }
    const cage_result *r = cage_prove_result(proof);
    add_result(&all_hash, r);
    field("the same in the least code: steps ", (uint64_t)r->steps);
    field(", slices ", (uint64_t)r->slices[0]);
    field(", balls ", triangulated(r->inserted));
    put(", hash ");
    put_hash(all_hash);
    put("\n");
    return 0;
}

/* One step at a time, as a controller would. */
static int32_t prove(const struct entry *e, const cage_scene *scene)
{
    cage_limits limits;
    cage_proof *proof;
    cage_limits_default(&limits, e->dim);
    limits.max_cells = e->dim == 2 ? 1024 : 8192;
    size_t size = cage_prove_size(scene, &limits), bytes = CAGE_PROVE_BYTES(e->dim, e->objects, e->obstacles, limits.max_cells);
    if (bytes < size || bytes > 2 * size) {
        put("CAGE_PROVE_BYTES is wrong\n");
        return 1;
    }
    int32_t state = cage_prove_begin(&proof, scene, &e->start, e->has_goal ? &e->goal : NULL, &limits, block.byte, BLOCK);
    uint64_t before = 0;
    while (state == 0) {
        uint64_t from = counter_now();
        state = cage_prove_run(proof, 1);
        uint64_t taken = counter_now() - from, after = triangulated(cage_prove_result(proof)->inserted);
        worst_step = taken > worst_step ? taken : worst_step;
        worst_balls = after - before > worst_balls ? after - before : worst_balls;
        before = after;
    }
    if (state < 0) {
        put("proof: ");
        put(cage_error_text(state));
        put("\n");
        return 1;
    }
    const cage_result *r = cage_prove_result(proof);
    uint64_t hash = all_hash;
    add_result(&hash, r);
    all_hash = hash;
    all_steps += (uint64_t)r->steps;
    most_bytes = r->peak_bytes > most_bytes ? r->peak_bytes : most_bytes;
    field(e->dim == 2 ? "plane " : "space ", (uint64_t)e->seed);
    put(": ");
    put(cage_verdict_text(r->verdict));
    field(", steps ", (uint64_t)r->steps);
    field(", slices ", (uint64_t)r->slices[0] + (uint64_t)r->slices[1]);
    field(", balls ", triangulated(r->inserted));
    field(", path ", (uint64_t)r->path_count);
    put(", hash ");
    put_hash(hash);
    put("\n");
    const cage_pose *goal = e->has_goal ? &e->goal : NULL;
    if (r->peak_bytes > 2 * size) {
        put("it took more than twice cage_prove_size\n");
        return 1;
    }
    if (r->verdict == CAGE_CAGED || r->verdict == CAGE_DISCONNECTED)
        return prove_small(e, scene, r->verdict);
    return r->path_count > 0 && cage_path_check(scene, &e->start, goal, r->pivot, r->path, r->path_count) != 1;
}

/* A part of 5 balls in 40 obstacles, in 64 KiB; where pointers have 64 bits, in half as much again. small: in the least code. */
static int32_t prove_in_bytes(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int32_t verdict, bool small)
{
    const cage_limits limits = {CAGE_SIDE_INNER, -1, 12, 16};
    cage_proof *proof;
    size_t bytes = sizeof(void *) == 4 ? 65536 : 98304;
    int32_t state = small ? cage_prove_begin_small(&proof, scene, start, goal, &limits, block.byte, bytes)
                          : cage_prove_begin(&proof, scene, start, goal, &limits, block.byte, bytes);
    while (state == 0)
        state = cage_prove_run_inner(proof, 1);
    if (state == CAGE_ERROR_MEMORY)
        field("in little memory: not enough, try ", cage_prove_result(proof)->needed_bytes);
    if (state < 0) {
        put("\n");
        return 1;
    }
    add_result(&all_hash, cage_prove_result(proof));
    field(small ? "in little memory and code: " : "in little memory: ", (uint64_t)scene->object.inner_count);
    field(" balls in ", (uint64_t)scene->obstacles.inner_count);
    put(": ");
    put(cage_verdict_text(cage_prove_result(proof)->verdict));
    put("\n");
    return cage_prove_result(proof)->verdict != verdict;
}

static int32_t prove_in_little(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int32_t verdict)
{
    return prove_in_bytes(scene, start, goal, verdict, false) + prove_in_bytes(scene, start, goal, verdict, true);
}

static int32_t draw(uint32_t *state, int32_t low, int32_t high)
{
    *state = *state * 1664525u + 1013904223u;
    return low + (int32_t)((*state >> 8) % (uint32_t)(high - low + 1));
}

/* Twelve such parts, each in a rough ring of obstacles that overlap their neighbours: closed, however they are drawn. */
static int32_t prove_rings(void)
{
    enum { BALLS = 40, PART = 5, COS = 1060522280 /* of 9 degrees, times 2^30 */, SIN = 167970228 };
    static cage_ball ring[BALLS], part[PART];
    const cage_shape object = {part, part, PART, PART}, obstacles = {ring, ring, BALLS, BALLS};
    const cage_scene scene = {object, obstacles, 2};
    const cage_pose start = {{0, 0, 0}, {1, 0, 0, 0}};
    int32_t failed = 0;
    for (uint32_t seed = 1; seed <= 12; seed++) {
        uint32_t state = 77777 * seed;
        int32_t size = draw(&state, 70000, 110000);
        int64_t x = size, y = 0;
        for (int32_t i = 0; i < PART; i++) {
            part[i].x = draw(&state, -20000, 20000); /* one after the other: the order is the compiler's in a list */
            part[i].y = draw(&state, -20000, 20000);
            part[i].r = draw(&state, 6000, 15000);
        }
        for (int32_t i = 0; i < BALLS; i++) {
            const int64_t far = draw(&state, 80, 120), turned = (x * COS - y * SIN) / (1 << 30);
            const cage_ball made = {(int32_t)(x * far / 100), (int32_t)(y * far / 100), 0,
                                    draw(&state, size / 100 * 24, size / 100 * 30)};
            ring[i] = made;
            y = (x * SIN + y * COS) / (1 << 30);
            x = turned;
        }
        failed += prove_in_little(&scene, &start, NULL, CAGE_CAGED);
    }
    return failed;
}

/* ---- atlases -------------------------------------------------------------------------------------------- */

/* Poses around the start, turned by all multiples of an eighth and some more. */
static uint64_t ask(const struct entry *e, const cage_atlas *atlas, uint64_t hash, uint64_t *asked)
{
    static const int32_t turn[6][2] = {{1, 0}, {5, 2}, {1, 1}, {0, 1}, {-3, 7}, {-1, 1}};
    int32_t step = (e->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D) / 40;
    for (int32_t i = 0; i < 5 * 5 * 6; i++) {
        cage_pose pose = e->start;
        pose.x[0] += (i % 5 - 2) * step;
        pose.x[1] += (i / 5 % 5 - 2) * step;
        pose.q[0] = turn[i / 25][0];
        pose.q[1] = e->dim == 3 ? turn[i % 6][1] : 0;
        pose.q[2] = 0;
        pose.q[3] = turn[i / 25][1];
        add(&hash, cage_atlas_ask(atlas, &pose, NULL));
        add(&hash, cage_atlas_ask(atlas, &e->start, &pose));
        add(&hash, cage_atlas_locate(atlas, &pose, CAGE_SIDE_INNER));
        add(&hash, cage_atlas_locate(atlas, &pose, CAGE_SIDE_OUTER));
        *asked += 4;
    }
    return hash;
}

static int32_t survey(const struct entry *e, const cage_scene *scene)
{
    cage_plan plan;
    cage_survey *made;
    cage_atlas atlas;
    cage_plan_default(&plan);
    plan.level = e->level;
    plan.max_cells = e->dim == 2 ? 100 : 0;
    size_t least = cage_survey_size(scene, &plan);
    size_t bytes = CAGE_SURVEY_BYTES(e->dim, e->objects, e->obstacles, e->dim == 2 ? 100 : e->level == 0 ? 4 : 32);
    if (bytes < least || bytes > 3 * least || e->level > (e->dim == 2 ? 4 : 1)) {
        put("CAGE_SURVEY_BYTES is wrong\n");
        return 1;
    }
    int32_t state = cage_survey_begin(&made, scene, &plan, block.byte, BLOCK);
    while (state == 0)
        state = cage_survey_run(made, 1);
    size_t size = state == 1 ? cage_survey_atlas(made, atlas_bytes, sizeof atlas_bytes) : 0;
    if (state < 0 || size > sizeof atlas_bytes || cage_atlas_open(&atlas, atlas_bytes, size) != CAGE_OK) {
        put("atlas: ");
        put(state < 0 ? cage_error_text(state) : "was not opened");
        put("\n");
        return 1;
    }
    const cage_survey_result *r = cage_survey_result_of(made);
    uint64_t hash = all_hash, asked = 0;
    for (size_t i = 0; i < size; i++)
        hash = hash_byte(hash, atlas_bytes[i]);
    for (int32_t side = 0; side < 2; side++)
        for (int32_t k = 0; k < atlas.classes[side]; k++) {
            cage_class class;
            add(&hash, cage_atlas_class(&atlas, side == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER, k, &class));
            add(&hash, class.nodes);
            add_pose(&hash, &class.pose);
        }
    hash = ask(e, &atlas, hash, &asked);
    all_hash = hash;
    all_steps += (uint64_t)r->steps;
    most_bytes = r->peak_bytes > most_bytes ? r->peak_bytes : most_bytes;
    field(e->dim == 2 ? "atlas, plane " : "atlas, space ", (uint64_t)e->seed);
    field(": bytes ", size);
    field(", steps ", (uint64_t)r->steps);
    field(", classes ", (uint64_t)r->classes[0]);
    field(" and ", (uint64_t)r->classes[1]);
    if (r->peak_bytes > 2 * bytes) {
        put("it took more than twice CAGE_SURVEY_BYTES\n");
        return 1;
    }
    field(", questions ", asked);
    put(", hash ");
    put_hash(hash);
    put("\n");
    return 0;
}

int main(void)
{
    int32_t failed = 0;
    all_hash = 14695981039346656037u;
    counter_start();
    for (int32_t i = 0; i < ENTRIES; i++) {
        const struct entry *e = &table[i];
        const cage_shape object = {e->object, e->object, e->objects, e->objects};
        const cage_shape obstacles = {e->obstacle, e->obstacle, e->obstacles, e->obstacles};
        const cage_scene scene = {object, obstacles, e->dim};
        failed += prove(e, &scene);
        failed += e->level >= 0 ? survey(e, &scene) : 0;
        failed += e->seed == 193 ? prove_in_little(&scene, &e->start, &e->goal, CAGE_DISCONNECTED) : 0;
    }
    failed += prove_rings();
    field("all: failed ", (uint64_t)failed);
    field(", steps ", all_steps);
    field(", most balls in a step ", worst_balls);
    put(", hash ");
    put_hash(all_hash);
    field("\nhere: arena ", most_bytes);
    field(", worst step ", worst_step);
    put("\n");
    return failed != 0;
}
