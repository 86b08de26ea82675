/* rename.h: gives every global name of wide and predicate the prefix PREFIX, for a second build beside the first.
 *
 * A name that is missing here shows as a multiple definition when a test is linked. */
#ifndef RENAME_H
#define RENAME_H

#define CAGE_SHARED static inline /* compiled here, for this build alone */

#define RENAME_JOIN(a, b) a##b
#define RENAME_WITH(a, b) RENAME_JOIN(a, b)
#define RENAME(name) RENAME_WITH(PREFIX, name)

#define cage_u128_divide_by_bits RENAME(u128_divide_by_bits)
#define cage_i128_nearest RENAME(i128_nearest)
#define cage_i128_floor RENAME(i128_floor)
#define cage_u128_root RENAME(u128_root)
#define cage_i256_add_product RENAME(i256_add_product)
#define cage_i256_sign RENAME(i256_sign)

#define CAGE_FACE_2D RENAME(face_2d)
#define CAGE_FACE_3D RENAME(face_3d)
#define cage_norm_compare RENAME(norm_compare)
#define cage_simplex_volume RENAME(simplex_volume)
#define cage_orthocentre RENAME(orthocentre)
#define cage_simplex_power RENAME(simplex_power)
#define cage_centre_side RENAME(centre_side)
#define cage_centre_off RENAME(centre_off)
#define cage_facet_power RENAME(facet_power)
#define cage_facet_attached RENAME(facet_attached)
#define cage_edges_covered RENAME(edges_covered)
#define cage_tetrahedron_covered RENAME(tetrahedron_covered)

#endif
