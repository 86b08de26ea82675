/* flood.c: the complement of a union of balls on a dense grid: what is surely joined in it, and what is surely not. */
#include "flood.h"

#include <stdlib.h>

#include "support.h"

enum { DEPTH = 3 };

struct box {
    int64_t at[3], half[3];
};

static int64_t size_of(int64_t a) { return a < 0 ? -a : a; }

/* Does a closed ball hold the whole box? */
static bool inside_one(const struct box *box, const cage_ball *ball, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        const int64_t z[3] = {ball[i].x, ball[i].y, ball[i].z};
        int64_t square = 0;
        for (int k = 0; k < 3; k++) {
            int64_t far = size_of(box->at[k] - z[k]) + box->half[k];
            square += far * far;
        }
        if (square <= (int64_t)ball[i].r * ball[i].r)
            return true;
    }
    return false;
}

/* Proved covered: by one ball, or in halves. */
static bool covered(const struct box *box, const cage_ball *ball, int32_t count, int depth)
{
    if (inside_one(box, ball, count))
        return true;
    if (depth == 0)
        return false;
    int axis = 0;
    for (int k = 1; k < 3; k++)
        axis = box->half[k] > box->half[axis] ? k : axis;
    for (int side = -1; side <= 1; side += 2) {
        struct box part = *box;
        part.half[axis] /= 2;
        part.at[axis] += side * part.half[axis];
        if (!covered(&part, ball, count, depth - 1))
            return false;
    }
    return true;
}

/* Is the segment from p, `length` along the axis, off every closed ball? */
static bool segment_clear(const int32_t p[3], int axis, int32_t length, const cage_ball *ball, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        const int64_t z[3] = {ball[i].x, ball[i].y, ball[i].z};
        int64_t square = 0;
        for (int k = 0; k < 3; k++) {
            int64_t far = z[k] - p[k];
            if (k == axis)
                far = far < 0 ? far : far > length ? far - length : 0;
            square += far * far;
        }
        if (square <= (int64_t)ball[i].r * ball[i].r)
            return false;
    }
    return true;
}

bool flood_clear(const cage_ball *ball, int32_t count, const int32_t p[3])
{
    return segment_clear(p, 0, 0, ball, count);
}

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void join(int32_t *parent, int32_t a, int32_t b)
{
    a = root_of(parent, a);
    b = root_of(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

void flood_centre(const struct flood *flood, int32_t cell, int32_t p[3])
{
    p[0] = flood->origin[0] + flood->pitch * (cell % flood->n[0]);
    p[1] = flood->origin[1] + flood->pitch * (cell / flood->n[0] % flood->n[1]);
    p[2] = flood->origin[2] + flood->pitch * (cell / flood->n[0] / flood->n[1]);
}

int32_t flood_cell(const struct flood *flood, const int32_t p[3])
{
    int32_t at[3];
    for (int k = 0; k < 3; k++) {
        at[k] = k < flood->dim ? (p[k] - flood->origin[k] + flood->pitch / 2) / flood->pitch : 0;
        test_require(at[k] >= 0 && at[k] < flood->n[k]);
    }
    return (at[2] * flood->n[1] + at[1]) * flood->n[0] + at[0];
}

static void lay(struct flood *flood, const cage_ball *ball, int32_t count)
{
    flood->cells = 1;
    for (int k = 0; k < 3; k++) {
        int32_t low = 0, high = 0;
        for (int32_t i = 0; i < count; i++) {
            int32_t z = k == 0 ? ball[i].x : k == 1 ? ball[i].y : ball[i].z;
            low = i == 0 || z - ball[i].r < low ? z - ball[i].r : low;
            high = i == 0 || z + ball[i].r > high ? z + ball[i].r : high;
        }
        flood->origin[k] = k < flood->dim ? low - 2 * flood->pitch : 0;
        flood->n[k] = k < flood->dim ? (high - low) / flood->pitch + 5 : 1;
        flood->cells *= flood->n[k];
    }
}

void flood_make(struct flood *flood, int32_t dim, const cage_ball *ball, int32_t count, int32_t pitch)
{
    test_require(pitch % 16 == 0);
    flood->dim = dim;
    flood->pitch = pitch;
    lay(flood, ball, count);
    flood->joined = test_alloc((size_t)flood->cells * sizeof *flood->joined);
    flood->apart = test_alloc((size_t)flood->cells * sizeof *flood->apart);
    for (int32_t c = 0; c < flood->cells; c++)
        flood->joined[c] = flood->apart[c] = c;
    for (int32_t c = 0; c < flood->cells; c++) {
        int32_t p[3], step = 1;
        flood_centre(flood, c, p);
        for (int axis = 0; axis < dim; step *= flood->n[axis++]) {
            if ((c / step) % flood->n[axis] == flood->n[axis] - 1)
                continue;
            if (segment_clear(p, axis, pitch, ball, count))
                join(flood->joined, c, c + step);
            struct box face = {{p[0], p[1], p[2]}, {0, 0, 0}};
            face.at[axis] += pitch / 2;
            for (int k = 0; k < dim; k++)
                face.half[k] = k == axis ? 0 : pitch / 2;
            if (!covered(&face, ball, count, DEPTH * (dim - 1)))
                join(flood->apart, c, c + step);
        }
    }
    for (int32_t c = 0; c < flood->cells; c++) {
        int32_t p[3];
        flood_centre(flood, c, p);
        flood->apart[c] = root_of(flood->apart, c);
        flood->joined[c] = root_of(flood->joined, c);
        if (!flood_clear(ball, count, p))
            flood->joined[c] = -1;
    }
}

void flood_free(struct flood *flood)
{
    free(flood->joined);
    free(flood->apart);
}

/* Cells of an `apart` class whose clear centres are all joined are decided: the truth lies between the two. */
static long count_decided(const struct flood *flood)
{
    int32_t *joined = test_alloc((size_t)flood->cells * sizeof *joined);
    long decided = 0;
    for (int32_t c = 0; c < flood->cells; c++)
        joined[c] = -1;
    for (int32_t c = 0; c < flood->cells; c++) {
        int32_t *of = &joined[flood->apart[c]];
        if (flood->joined[c] >= 0)
            *of = *of == -1 || *of == flood->joined[c] ? flood->joined[c] : -2;
    }
    for (int32_t c = 0; c < flood->cells; c++)
        decided += flood->joined[c] >= 0 && joined[flood->apart[c]] >= 0;
    free(joined);
    return decided;
}

const char *flood_contradicts(const struct flood *flood, const int32_t *label, int32_t labels, long *decided)
{
    const char *wrong = NULL;
    int32_t *apart = test_alloc((size_t)labels * sizeof *apart);
    for (int32_t l = 0; l < labels; l++)
        apart[l] = -1;
    for (int32_t c = 0; c < flood->cells; c++) {
        if ((label[c] < 0) != (flood->joined[c] < 0))
            wrong = "a point is free for one and covered for the other";
        if (label[c] >= labels)
            wrong = "a label out of range";
        if (label[c] < 0 || wrong)
            continue;
        if (label[c] != label[flood->joined[c]])
            wrong = "two points are joined, but not labelled alike";
        if (apart[label[c]] >= 0 && apart[label[c]] != flood->apart[c])
            wrong = "two points are labelled alike, but not joined";
        apart[label[c]] = flood->apart[c];
    }
    if (label[0] != 0)
        wrong = "the outside is not number 0";
    *decided += count_decided(flood);
    free(apart);
    return wrong;
}
