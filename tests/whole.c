/* whole.c: slices made without leaving out a single ball, and points located in them exactly. */
#include "whole.h"

#include <stdlib.h>
#include <string.h>

#include "flood.h"
#include "grid.h"
#include "support.h"

/* Triangulate and label out->ball; takes it over. */
static void label_all(int32_t dim, struct whole *out)
{
    struct cage_arena arena;
    size_t bytes = ((size_t)out->count + 8) * 2048 + 65536;
    out->block = test_alloc(bytes);
    cage_arena_init(&arena, out->block, bytes);
    test_require(cage_delaunay(&arena, &cage_all_shortcuts, dim, out->ball, out->count, &out->t) == CAGE_OK);
    test_require(cage_components(&arena, &out->t, &out->c) == CAGE_OK);
}

void whole_make(const struct cage_side *side, const struct cage_rotations *rotations, struct whole *out)
{
    struct cage_rotation rotation;
    cage_rotation_of(rotations->q, &rotation);
    out->count = 0;
    out->ball = test_alloc(((size_t)side->objects * (size_t)side->obstacles + 1) * sizeof *out->ball);
    for (int32_t j = 0; j < side->obstacles; j++)
        for (int32_t a = 0; a < side->objects; a++) {
            const cage_ball *x = &side->obstacle[j], *y = &side->object[a];
            const int32_t from[3] = {y->x, y->y, y->z};
            int32_t at[3], change = cage_radius_change(cage_displacement(rotations->turn, side->reach[a]), side->sign);
            cage_rotate(&rotation, from, at);
            cage_ball made = {x->x - at[0], x->y - at[1], x->z - at[2], x->r + y->r + change};
            if (made.r >= 0)
                out->ball[out->count++] = made;
        }
    label_all(side->dim, out);
}

void whole_mix(const struct whole *a, const struct whole *b, struct whole *out)
{
    out->count = a->count + b->count;
    out->ball = test_alloc((size_t)(out->count + 1) * sizeof *out->ball);
    memcpy(out->ball, a->ball, (size_t)a->count * sizeof *a->ball);
    memcpy(out->ball + a->count, b->ball, (size_t)b->count * sizeof *b->ball);
    label_all(a->t.dim, out);
}

void whole_free(struct whole *w)
{
    free(w->ball);
    free(w->block);
}

/* Is x in the closed simplex? l: scratch. */
static bool holds(const struct cage_triangulation *t, int32_t s, mpq_t x[3], mpq_t l[4])
{
    const struct cage_site *v[4];
    cage_simplex_sites(t, s, v);
    test_require(exact_barycentric(t->dim, v, x, l));
    for (int32_t i = 0; i <= t->dim; i++)
        if (mpq_sgn(l[i]) < 0)
            return false;
    return true;
}

int32_t whole_label(const struct cage_triangulation *in, const int32_t *label, const struct cage_triangulation *from, int32_t s)
{
    const struct cage_site *v[4];
    struct cage_centre centre;
    cage_simplex_sites(from, s, v);
    cage_orthocentre(from->dim, v, &centre);
    int32_t at = cage_delaunay_locate_centre(in, &centre, 0);
    if (at < 0)
        return CAGE_OUTSIDE;
    struct exact_centre right;
    mpq_t l[4];
    mpq_inits(l[0], l[1], l[2], l[3], NULL);
    exact_centre_init(&right);
    test_require(exact_centre_solve(from->dim + 1, v, &right));
    test_require(holds(in, at, right.x, l));
    exact_centre_clear(&right);
    mpq_clears(l[0], l[1], l[2], l[3], NULL);
    return label[at];
}

int32_t whole_locate(const struct whole *w, const int32_t p[3], int32_t *hint)
{
    *hint = cage_delaunay_locate(&w->t, p, *hint);
    return flood_clear(w->ball, w->count, p) ? w->c.label[*hint] : CAGE_COVERED;
}

int32_t whole_label_exact(const struct cage_triangulation *in, const int32_t *label, mpq_t x[3])
{
    int32_t found = CAGE_OUTSIDE;
    mpq_t l[4];
    mpq_inits(l[0], l[1], l[2], l[3], NULL);
    for (int32_t s = 0; s < in->simplices; s++)
        if (holds(in, s, x, l)) {
            found = label[s];
            break;
        }
    for (int32_t i = in->dim + 1; i < in->sites; i++) {
        exact_power(&in->site[i], x, l[0]);
        if (mpq_sgn(l[0]) <= 0)
            found = CAGE_COVERED;
    }
    mpq_clears(l[0], l[1], l[2], l[3], NULL);
    return found;
}
