/* backend_body.h: the body of a backend, compiled once for each build; the includer names it BACKEND. */

static cage_i128 narrow(words a) { return cage_i128_make(a.word[1], a.word[0]); }

static words widen(cage_i128 a)
{
    words out = {{cage_i128_low(a), cage_i128_high(a), 0, 0}};
    return out;
}

static words number(int64_t a)
{
    words out = {{(uint64_t)a, 0, 0, 0}};
    return out;
}

static cage_i256 all(words a)
{
    cage_i256 out = {{a.word[0], a.word[1], a.word[2], a.word[3]}};
    return out;
}

static words words_of(cage_i256 a)
{
    words out = {{a.word[0], a.word[1], a.word[2], a.word[3]}};
    return out;
}

static words backend_wide(enum wide_op op, words a, words b, int64_t c)
{
    cage_i128 x = narrow(a), y = narrow(b), rest;
    const cage_i256 none = {{0, 0, 0, 0}};
    cage_i256 sum;
    switch (op) {
    case WIDE_MAKE: return widen(x);
    case WIDE_OF: return widen(cage_i128_of(c));
    case WIDE_MUL: return widen(cage_i128_mul((int64_t)a.word[0], c));
    case WIDE_UMUL: return widen(cage_u64_mul(a.word[0], b.word[0]));
    case WIDE_ADD: return widen(cage_i128_add(x, y));
    case WIDE_SUB: return widen(cage_i128_sub(x, y));
    case WIDE_ADD_PRODUCT: cage_i128_add_product(&x, (int64_t)b.word[0], c); return widen(x);
    case WIDE_SCALE: return widen(cage_i128_scale(x, c));
    case WIDE_SHR: return widen(cage_i128_shr(x, (uint32_t)(b.word[0] % 128)));
    case WIDE_SHL: return widen(cage_i128_shl(x, (uint32_t)(b.word[0] % 128)));
    case WIDE_NEGATIVE: return number(cage_i128_negative(x));
    case WIDE_SIGN: return number(cage_i128_sign(x));
    case WIDE_ABS: return widen(cage_i128_abs(x));
    case WIDE_COMPARE: return number(cage_i128_compare(x, y));
    case WIDE_BITS: return number(cage_u128_bits(x));
    case WIDE_QUOTIENT: return widen(cage_u128_divide(x, y, &rest));
    case WIDE_REMAINDER: (void)cage_u128_divide(x, y, &rest); return widen(rest);
    case WIDE_SHORT_QUOTIENT: return number((int64_t)cage_u64_divide(a.word[0], b.word[0]));
    case WIDE_NEAREST: return number(cage_i128_nearest(x, y, c));
    case WIDE_FLOOR: return number(cage_i128_floor(x, y, c));
    case WIDE_ROOT: return number((int64_t)cage_u128_root(x));
    case WIDE_MINUS: return widen(cage_i128_minus(x));
    case WIDE_PRODUCT: sum = none; cage_i256_add_product(&sum, x, y); return words_of(sum);
    case WIDE_SUM: sum = all(a); cage_i256_add_product(&sum, y, cage_i128_of(c)); return words_of(sum);
    case WIDE_SIGN256: sum = all(a); return number(cage_i256_sign(&sum));
    default: return number(0);
    }
}

static int32_t backend_side(int32_t dim, const struct cage_site *const face[3], const struct cage_site *p)
{
    return cage_side(dim, face, p);
}

static bool backend_conflict(int32_t dim, const struct cage_site *const v[4], const struct cage_site *p)
{
    return cage_conflict(dim, v, p);
}

static words backend_volume(int32_t dim, const struct cage_site *const v[4])
{
    return widen(cage_simplex_volume(dim, v));
}

static int32_t backend_norm_compare(const words n[3], words g)
{
    const cage_i128 size[3] = {narrow(n[0]), narrow(n[1]), narrow(n[2])};
    return cage_norm_compare(size, narrow(g));
}

static int64_t backend_power(const struct cage_site *site, const int32_t p[3]) { return cage_power(site, p); }

static void backend_centre(int32_t dim, const struct cage_site *const v[4], words out[4])
{
    struct cage_centre centre;
    cage_orthocentre(dim, v, &centre);
    for (int32_t k = 0; k < 3; k++)
        out[k] = widen(centre.offset[k]);
    out[3] = widen(centre.denominator);
}

static int32_t backend_centre_side(int32_t dim, const struct cage_site *const face[3],
                                   const struct cage_site *const v[4])
{
    struct cage_centre centre;
    cage_orthocentre(dim, v, &centre);
    return cage_centre_side(dim, face, &centre);
}

static bool backend_centre_off(int32_t dim, const struct cage_site *const v[4], const struct cage_site *ball)
{
    struct cage_centre centre;
    cage_orthocentre(dim, v, &centre);
    return cage_centre_off(dim, &centre, ball);
}

#ifndef BACKEND_EXACT
#define BACKEND_EXACT NULL
#endif

#define BACKEND_TEXT_OF(name) #name
#define BACKEND_TEXT(name) BACKEND_TEXT_OF(name)

const struct backend BACKEND = {
    BACKEND_TEXT(BACKEND), backend_wide,         backend_side,        backend_conflict,     backend_volume,
    backend_norm_compare,  backend_power,        backend_centre,      cage_simplex_power,   backend_centre_side,
    backend_centre_off,    cage_facet_power,     cage_facet_attached, cage_edges_covered,   cage_tetrahedron_covered,
    BACKEND_EXACT,
};
