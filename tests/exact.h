/* exact.h: geometry in exact numbers, straight from the definitions: linear systems and elimination, no formula. */
#ifndef EXACT_H
#define EXACT_H

#include <gmp.h>

#include "predicate.h"

void exact_set(mpz_t out, int64_t a);

/* The point of the sites' affine hull that has equal power to all of them, and that power. */
struct exact_centre {
    mpq_t x[3], power;
};

void exact_centre_init(struct exact_centre *centre);
void exact_centre_clear(struct exact_centre *centre);

/* False when the count sites are affinely dependent. */
bool exact_centre_solve(int count, const struct cage_site *const v[], struct exact_centre *out);

/* |x - z|^2 minus the weight |z|^2 - h of the site. */
void exact_power(const struct cage_site *site, mpq_t x[3], mpq_t out);

/* Coordinates of x in terms of the dim + 1 vertices: sum 1, sum of products x. False when the simplex is flat. */
bool exact_barycentric(int dim, const struct cage_site *const v[4], mpq_t x[3], mpq_t out[4]);

/* Is the whole facet in the union of the closed balls at its vertices? Decided, both ways. */
bool exact_covered(int dim, const struct cage_site *const facet[3]);

/* Is the sum of l_i l_k square[i][k] over the pairs i < k of up to 4, less the sum of l_i weight_i, positive for no l
 * >= 0 of sum 1? Decided, both ways. */
bool exact_nowhere_positive(int count, int64_t square[4][4], const int64_t weight[4]);

/* Of the first n rows and columns. */
void exact_determinant(int n, int64_t entries[4][4], mpz_t out);

/* det(v_1 - v_0, ..., v_dim - v_0). */
void exact_volume(int dim, const struct cage_site *const v[4], mpz_t out);
int exact_orientation(int dim, const struct cage_site *const v[4]);

/* How far site p lies above the hyperplane through the heights of a positive simplex, times its volume. */
void exact_lift(int dim, const struct cage_site *const v[4], const struct cage_site *p, mpz_t out);

/* The sign of that, heights h_i + e_i with 0 < e_0 << e_1 << ... by index in `site`: 1 or -1, as p is no vertex of the
 * positive simplex v. *ties counts the cases that the e_i decided. */
int exact_above(int dim, const struct cage_site *site, const int32_t v[4], int32_t p, long *ties);

#endif
