/* pockets.c: scenes with a pair of rotations whose slices have many small components, next to contact, in the plane
 * and in space. */
#include "pockets.h"

#include <string.h>

#include "fibre.h"
#include "grid.h"
#include "support.h"

/* Centres and radii within 90 units in all, or within 50 and displacements and the object within 30: all fits 100 units. */
struct maker {
    uint64_t state;
    int32_t dim;
    int64_t unit;
    int64_t radius; /* that collision balls are to have */
    struct pockets *out;
};

static int64_t draw(struct maker *m, int64_t low, int64_t high) { return test_between(&m->state, low, high); }

/* A length of up to so many thousandths of a unit, of either sign. */
static int64_t part(struct maker *m, int64_t thousandths) { return draw(m, -thousandths, thousandths) * m->unit / 1000; }

static void obstacle(struct maker *m, int64_t x, int64_t y, int64_t z, int64_t r)
{
    if (m->out->obstacles == POCKETS_OBSTACLES)
        return;
    cage_ball made = {(int32_t)x, (int32_t)y, m->dim == 3 ? (int32_t)z : 0, (int32_t)r};
    m->out->obstacle[m->out->obstacles++] = made;
}

static void jittered(struct maker *m, int64_t x, int64_t y, int64_t z, int64_t jitter)
{
    int64_t moved[3];
    for (int k = 0; k < 3; k++)
        moved[k] = part(m, jitter);
    obstacle(m, x + moved[0], y + moved[1], z + moved[2], m->radius + part(m, jitter));
}

/* A block of a lattice: edges[k] units between neighbours; cells of it are closed while their middle is not yet covered. */
static void lattice(struct maker *m, const int64_t edge[3], int64_t jitter, int32_t missing)
{
    int64_t n[3] = {draw(m, 2, 4), draw(m, 2, 4), m->dim == 3 ? draw(m, 2, 4) : 1};
    if (m->dim == 2) {
        n[0] = draw(m, 2, 8);
        n[1] = draw(m, 2, 5);
    }
    for (int64_t i = 0; i < n[0]; i++)
        for (int64_t j = 0; j < n[1]; j++)
            for (int64_t k = 0; k < n[2]; k++)
                if (draw(m, 0, 99) >= missing)
                    jittered(m, i * edge[0] - (n[0] - 1) * edge[0] / 2, j * edge[1] - (n[1] - 1) * edge[1] / 2,
                             k * edge[2] - (n[2] - 1) * edge[2] / 2, jitter);
}

static void make_square(struct maker *m, int64_t jitter, int32_t missing)
{
    const int64_t edge[3] = {m->unit, m->unit, m->unit};
    m->radius = m->unit * (m->dim == 3 ? draw(m, 695, 872) : draw(m, 490, 712)) / 1000;
    lattice(m, edge, jitter, missing);
}

static void make_exact(struct maker *m) { make_square(m, 0, 0); }
static void make_loose(struct maker *m)
{
    make_square(m, draw(m, 0, 1) ? draw(m, 0, 20) : draw(m, 0, 150), (int32_t)draw(m, 0, 5));
}

/* Boxes with integer diagonals: balls meet in their very middle, or one unit of length before or behind it. */
static void make_ties(struct maker *m)
{
    static const int64_t box[4][4] = {{6, 8, 0, 5}, {10, 24, 0, 13}, {2, 4, 4, 3}, {4, 6, 12, 7}};
    const int64_t *b = box[2 * (m->dim - 2) + draw(m, 0, 1)], scale = m->unit / b[3] > 0 ? m->unit / b[3] : 1;
    const int64_t edge[3] = {scale * b[0], scale * b[1], scale * b[2]};
    m->radius = scale * b[3] - draw(m, -1, 3);
    lattice(m, edge, 0, 0);
}

/* A lattice and another one in the middle of its cells, of other radii: at 0 they add nothing. */
static void make_filled(struct maker *m)
{
    make_square(m, 0, 0);
    int32_t count = m->out->obstacles;
    int64_t r = draw(m, 0, 3) ? m->unit * draw(m, 0, 250) / 1000 : 0, off = draw(m, 0, 2) ? m->unit / 2 : part(m, 500);
    for (int32_t i = 0; i < count && draw(m, 0, 9) > 0; i++)
        obstacle(m, m->out->obstacle[i].x + off, m->out->obstacle[i].y + off, m->out->obstacle[i].z + off, r);
}

static void make_dense(struct maker *m)
{
    int64_t count = draw(m, 4, POCKETS_OBSTACLES), half = m->dim == 3 ? draw(m, 500, 2400) : draw(m, 1000, 5000);
    m->radius = m->unit;
    for (int64_t i = 0; i < count; i++)
        obstacle(m, part(m, half), part(m, half), part(m, half), draw(m, 0, 5) ? m->radius : m->unit * draw(m, 0, 1500) / 1000);
}

/* Few places, many balls: coincident, nested, concentric. */
static void make_nested(struct maker *m)
{
    int64_t count = draw(m, 4, POCKETS_OBSTACLES), step = m->unit;
    m->radius = m->unit * draw(m, 500, 900) / 1000;
    for (int64_t i = 0; i < count; i++)
        obstacle(m, draw(m, -1, 1) * step, draw(m, -1, 1) * step, draw(m, -1, 1) * step,
                 m->radius - (draw(m, 0, 2) ? 0 : m->unit * draw(m, 0, 2) / 4));
}

/* Integer points of a circle of radius 5 or a sphere of radius 3 with a hollow inside, maybe with something in it,
 * maybe filled by a ball that none but the others can touch. */
static void make_round(struct maker *m)
{
    int32_t size = m->dim == 2 ? 5 : 3, deep = m->dim == 2 ? 0 : size;
    int64_t step = 2 * m->unit / size, jitter = draw(m, 0, 1) ? draw(m, 0, 60) : 0, inside = draw(m, 0, 9);
    m->radius = step * draw(m, 900, 2400) / 1000;
    for (int32_t z = -deep; z <= deep; z++)
        for (int32_t y = -size; y <= size; y++)
            for (int32_t x = -size; x <= size; x++)
                if (x * x + y * y + z * z == size * size && draw(m, 0, 99) > 2)
                    jittered(m, x * step, y * step, z * step, jitter);
    if (draw(m, 0, 2) == 0)
        obstacle(m, part(m, 50), part(m, 50), part(m, 50), m->unit * draw(m, 500, 2000) / 1000);
    for (int64_t i = 0; i < inside; i++)
        obstacle(m, part(m, 1000), part(m, 1000), part(m, 1000), draw(m, 0, 1) ? m->radius : m->unit * draw(m, 0, 300) / 1000);
}

/* The largest integer of that square or less. */
static int64_t root_of(int64_t square)
{
    int64_t root = 0;
    for (int64_t bit = INT64_C(1) << 30; bit > 0; bit /= 2)
        if ((root + bit) * (root + bit) <= square)
            root += bit;
    return root;
}

/* A hollow above the place where big balls hardly cover the middle between them, a small ball that closes it, a big
 * one behind it, and below nothing free or the same. The object moves by as much as that place can bear: so that the
 * border passes over the hollow's centre while the hollow still meets itself, or that the upper hollow all but meets
 * the lower one. In 64ths of a unit: covered from -64 to 64, then free up to `top`; the orthocentre is at `centre`. */
static void make_slit(struct maker *m)
{
    static const int64_t at[5][2] = {{-1000, 0}, {1000, 0}, {-500, 866}, {-500, -866}, {1000, 0}};
    bool both = draw(m, 0, 1);
    int64_t u = m->unit / 2, wide = draw(m, 8, 80), r = root_of((wide * wide + 1) * u * u);
    int64_t centre = draw(m, 90, both ? 300 : 128), move = both            ? draw(m, 110, 150)
                                                           : draw(m, 0, 4) ? draw(m, centre, 128)
                                                                           : draw(m, 64, 140);
    int64_t least = both ? centre + 8 : move + 62, most = centre + root_of(centre * centre - 64 * 64);
    int64_t top = draw(m, least, most > least ? most : least), high = (top * top - 64 * 64) / (2 * (top - centre));
    high = high > 8 * 64 ? 8 * 64 : high;
    int64_t small = (high > top ? high - top : 1) * u / 64,
            big = (wide + 5) * u + draw(m, -32, high > top ? high - top : 0) * u / 64;
    for (int32_t i = 2 * (m->dim - 2); i < (m->dim == 2 ? 2 : 5); i++)
        obstacle(m, at[i][0] * wide * u / 1000, 0, at[i][1] * wide * u / 1000, r);
    for (int64_t up = both ? -1 : 1; up <= 1; up += 2) {
        obstacle(m, 0, up * high * u / 64, 0, small);
        obstacle(m, 0, up * ((wide + 5) * u + high * u / 64), 0, big);
    }
    if (!both)
        obstacle(m, 0, -(wide + 5) * u, 0, (wide + 5) * u);
    m->out->objects = 1;
    m->out->object[0].y = (int32_t)(-move * u / 128);
    m->out->object[0].x = (int32_t)(draw(m, 0, 1) ? part(m, 100) : 0);
    for (int32_t i = 0; i < 2; i++) {
        const struct cage_rotations made = {{1 - i, 0, 0, i}, 0};
        m->out->at[i] = made;
    }
}

static void make_object(struct maker *m)
{
    static const int64_t sizes[6] = {0, 30, 200, 700, 1500, 4000};
    struct pockets *out = m->out;
    int64_t size = sizes[draw(m, 0, 5)], fat = draw(m, 0, 2) ? 0 : draw(m, 0, 200), along[3];
    bool in_line = draw(m, 0, 3) == 0;
    out->objects = (int32_t)(draw(m, 0, 2) ? draw(m, 1, POCKETS_OBJECT) : 1);
    for (int k = 0; k < 3; k++)
        along[k] = part(m, 1000);
    for (int32_t a = 0; a < out->objects; a++) {
        int64_t y[3], much = draw(m, -size, size);
        for (int k = 0; k < 3; k++)
            y[k] = in_line ? along[k] * much / 1000 : part(m, size);
        cage_ball made = {(int32_t)y[0], (int32_t)y[1], m->dim == 3 ? (int32_t)y[2] : 0,
                          (int32_t)(m->unit * draw(m, 0, fat) / 1000)};
        out->object[a] = a > 0 && draw(m, 0, 9) == 0 ? out->object[a - 1] : made;
    }
    const cage_shape shape = {out->object, out->object, out->objects, out->objects};
    memset(out->pivot, 0, sizeof out->pivot);
    int64_t where = draw(m, 0, 3);
    if (where < 2)
        cage_pivot(&shape, out->pivot);
    for (int32_t k = 0; where == 3 && k < m->dim; k++)
        out->pivot[k] = (int32_t)part(m, draw(m, 0, 4000));
}

/* A random cell of the level, touching that one if it is not null. */
static void choose_cell(struct maker *m, const struct cage_fibre *fibre, int64_t level, const struct cage_cell *beside,
                        struct cage_cell *out)
{
    do {
        const struct cage_cell root = {0, (int32_t)draw(m, 0, fibre->roots - 1), {0, 0, 0}};
        *out = root;
    } while (beside && !fibre->touch(out, beside));
    while (out->level < level) {
        struct cage_cell child;
        do
            cage_cell_child(out, (int32_t)draw(m, 0, fibre->children - 1), &child);
        while (beside && !fibre->touch(&child, beside));
        *out = child;
    }
}

/* Touching cells of equal or different levels, any two coarse cells, any two rotations, a cell and its own rotation,
 * equal ones. */
static void choose_rotations(struct maker *m)
{
    const struct cage_fibre *fibre = m->dim == 2 ? &cage_so2 : &cage_so3;
    struct cage_cell cell[2];
    int64_t kind = draw(m, 0, 7), level = kind == 0 ? draw(m, 0, 3) : draw(m, 1, fibre->max_level - 2);
    choose_cell(m, fibre, level, NULL, &cell[0]);
    if (kind == 0)
        choose_cell(m, fibre, draw(m, 0, 3), NULL, &cell[1]);
    else
        choose_cell(m, fibre, level + draw(m, level > 2 ? -2 : 0, 2), &cell[0], &cell[1]);
    for (int32_t i = 0; i < 2; i++) {
        struct cage_rotations *at = &m->out->at[i];
        fibre->representative(&cell[i], at->q);
        at->turn = kind == 1 || kind == 2 ? 0 : fibre->turn(&cell[i]);
        for (int32_t k = 0; k < 4 && kind == 1; k++)
            at->q[k] = m->dim == 3 || k % 3 == 0 ? (int32_t)draw(m, 1, 1 << 20) - (1 << 19) : 0;
    }
    if (kind == 3 || kind == 4)
        m->out->at[1] = m->out->at[0];
    if (kind == 3)
        m->out->at[draw(m, 0, 1)].turn = 0;
    if (draw(m, 0, 5) == 0) /* as if the cell were larger: radii that differ much, balls that are in one slice alone */
        m->out->at[draw(m, 0, 1)].turn = draw(m, 0, (int64_t)1 << 30);
}

/* Obstacles were made as large as collision balls should be: take off what the first object ball adds, in either
 * slice or between them. */
static void fit_radii(struct maker *m)
{
    struct pockets *out = m->out;
    int64_t change[2];
    for (int32_t i = 0; i < 2; i++) {
        const int32_t y[3] = {out->object[0].x - out->pivot[0], out->object[0].y - out->pivot[1],
                              out->object[0].z - out->pivot[2]};
        change[i] = cage_radius_change(cage_displacement(out->at[i].turn, cage_length(y)), out->sign) + out->object[0].r;
    }
    int64_t kind = draw(m, 0, 2), off = kind == 2 ? (change[0] + change[1]) / 2 : change[kind];
    for (int32_t j = 0; j < out->obstacles; j++) {
        int64_t r = out->obstacle[j].r - off;
        out->obstacle[j].r = (int32_t)(r < 0 ? 0 : r);
    }
}

void pockets_make(int32_t dim, uint64_t seed, struct pockets *out)
{
    static void (*const kinds[9])(struct maker *) = {make_exact,  make_loose, make_loose, make_ties, make_filled,
                                                     make_dense, make_nested, make_round, make_slit};
    struct maker m = {2 * seed + (uint64_t)dim - 2, dim, 0, 0, out};
    memset(out, 0, sizeof *out);
    out->dim = dim;
    out->sign = draw(&m, 0, 2) ? -1 : 1;
    int64_t size = draw(&m, 0, 3), most = (dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D) / 100;
    m.unit = size == 0 ? draw(&m, out->sign < 0 ? 4 : 20, 100) : size == 1 ? most : draw(&m, 100, 20000);
    kinds[draw(&m, 0, 8)](&m);
    if (out->objects == 0) {
        make_object(&m);
        choose_rotations(&m);
    }
    fit_radii(&m);
}

void pockets_vanish(int32_t dim, uint64_t seed, struct pockets *out)
{
    static const int64_t around[2][8][3] = {
        {{1000, 0, 0}, {-500, 866, 0}, {-500, -866, 0}, {900, 900, 0}, {1800, 0, 0}, {-1500, 1500, 0}, {0, -1800, 0}, {0, 1800, 0}},
        {{577, 577, 577}, {577, -577, -577}, {-577, 577, -577}, {-577, -577, 577},
         {1500, 0, 0}, {0, 1500, 0}, {0, 0, -1500}, {-1500, 0, 0}}};
    struct maker m = {2 * seed + (uint64_t)dim - 2, dim, 1, 0, out};
    memset(out, 0, sizeof *out);
    out->dim = dim;
    out->sign = -1;
    int64_t radius = draw(&m, 6, 60), far_radius = draw(&m, 0, 8), away = draw(&m, radius / 2, radius + far_radius);
    int64_t far = draw(&m, 0, 1) ? draw(&m, 4, 400) * radius / 10 : draw(&m, 1, 30) * radius, balls = draw(&m, dim + 1, 2 * dim + 2);
    for (int64_t i = 0; i < balls; i++) {
        const int64_t *to = around[dim - 2][i];
        obstacle(&m, to[0] * away / 1000 + draw(&m, -3, 3), to[1] * away / 1000 + draw(&m, -3, 3),
                 to[2] * away / 1000 + draw(&m, -3, 3), radius + draw(&m, -1, 1));
    }
    const cage_ball near = {0, 0, 0, (int32_t)draw(&m, 0, 4)};
    out->object[out->objects++] = near;
    for (int64_t i = draw(&m, 1, 2); i > 0; i--) {
        const cage_ball made = {(int32_t)(i == 1 ? far : -far), 0, 0, (int32_t)far_radius};
        const cage_ball turned = {0, made.x, 0, made.r};
        out->object[out->objects++] = draw(&m, 0, 2) ? made : turned;
    }
    int64_t gone = (radius + far_radius + 4) * ((int64_t)1 << 31) / far + draw(&m, 0, 1000000), most = (int64_t)1 << 32;
    int32_t wide = (int32_t)draw(&m, 0, 1), turn = draw(&m, 0, 1) ? 0 : (int32_t)draw(&m, -1000, 1000);
    out->at[wide].turn = gone < most ? gone : most;
    for (int32_t i = 0; i < 2; i++) {
        out->at[i].q[0] = 1024;
        out->at[i].q[3] = turn;
    }
}

void pockets_side(struct cage_arena *arena, const struct pockets *p, struct cage_side *side)
{
    const cage_scene scene = {
        {p->object, p->object, p->objects, p->objects}, {p->obstacle, p->obstacle, p->obstacles, p->obstacles}, p->dim};
    test_require(cage_scene_check(&scene) == CAGE_OK);
    test_require(cage_side_make(arena, &scene, p->pivot, p->sign, &cage_all_shortcuts, side) == CAGE_OK);
}

void pockets_print(FILE *file, const struct pockets *p)
{
    fprintf(file, "dim %d, sign %d, pivot %d %d %d\n", (int)p->dim, (int)p->sign, (int)p->pivot[0], (int)p->pivot[1],
            (int)p->pivot[2]);
    for (int32_t i = 0; i < 2; i++)
        fprintf(file, "rotation %d %d %d %d turn %lld\n", (int)p->at[i].q[0], (int)p->at[i].q[1], (int)p->at[i].q[2],
                (int)p->at[i].q[3], (long long)p->at[i].turn);
    for (int32_t i = 0; i < p->objects; i++)
        fprintf(file, "object %d %d %d %d\n", (int)p->object[i].x, (int)p->object[i].y, (int)p->object[i].z, (int)p->object[i].r);
    for (int32_t i = 0; i < p->obstacles; i++)
        fprintf(file, "obstacle %d %d %d %d\n", (int)p->obstacle[i].x, (int)p->obstacle[i].y, (int)p->obstacle[i].z,
                (int)p->obstacle[i].r);
}
