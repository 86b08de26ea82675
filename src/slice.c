/* slice: object balls, obstacle balls and one cell give collision balls, their triangulation and its components. */
#include "slice.h"
#include "border.h"
#include "grid.h"
#include "prune.h"

#include <string.h>

static void place_parts(const struct cage_side *side, const struct cage_rotations *rotations, const struct cage_corners *corners,
                  struct cage_part *part)
{
    struct cage_rotation rotation;
    cage_rotation_of(rotations->q, &rotation);
    for (int32_t a = 0; a < side->objects; a++) {
        const cage_ball *ball = &side->object[a];
        const int32_t y[3] = {ball->x, ball->y, ball->z};
        cage_rotate(&rotation, y, part[a].at);
        part[a].displacement = cage_displacement(rotations->turn, side->reach[a]);
        int32_t within = corners ? cage_displacement_within(corners, y) : part[a].displacement;
        part[a].displacement = within < part[a].displacement ? within : part[a].displacement;
        part[a].change = cage_radius_change(part[a].displacement, side->sign);
    }
}

/* All collision balls and their parts; a ball whose radius comes out negative is none. Returns their number. */
static int32_t collide(const struct cage_side *side, const struct cage_part *part, cage_ball *ball, int32_t *of)
{
    int32_t count = 0;
    for (int32_t a = 0; a < side->objects; a++)
        for (int32_t j = 0; j < side->obstacles; j++) {
            const cage_ball *x = &side->obstacle[j];
            int32_t radius = x->r + side->object[a].r + part[a].change;
            if (radius < 0)
                continue;
            cage_ball made = {x->x - part[a].at[0], x->y - part[a].at[1], x->z - part[a].at[2], radius};
            ball[count] = made;
            of[count++] = a;
        }
    return count;
}

bool cage_slice_clear(const struct cage_slice *slice, const int32_t p[3])
{
    for (int32_t i = slice->t.dim + 1; i < slice->t.sites; i++)
        if (cage_power(&slice->t.site[i], p) <= 0)
            return false;
    return true;
}

int32_t cage_slice_locate(const struct cage_slice *slice, const int32_t p[3])
{
    int32_t label = slice->label[cage_delaunay_locate(&slice->t, p, 0)];
    return label != CAGE_COVERED && cage_slice_clear(slice, p) ? label : CAGE_COVERED;
}

/* Round the deep orthocentre of a component to the grid; it is known if it still lies in it. */
static void find_point(const struct cage_slice *slice, int32_t component, int32_t largest)
{
    struct cage_region *region = &slice->region[component];
    region->known = 0;
    if (region->deep < 0)
        return;
    struct cage_orthoball ball;
    cage_orthoball_of(&slice->t, region->deep, &ball);
    if (ball.radius < 0)
        return;
    for (int32_t k = 0; k < 3; k++)
        region->point[k] = ball.at[k];
    int32_t s = cage_delaunay_locate(&slice->t, region->point, region->deep);
    region->known = slice->label[s] == component &&
                    (cage_orthoball_is_off(&slice->t, &ball, largest) || cage_slice_clear(slice, region->point));
}

/* Where the bounded components are: among the balls, so that the orthocentres are within CAGE_REACH too. */
static int32_t find_orthoballs(struct cage_arena *arena, struct cage_slice *slice)
{
    slice->orthoballs = 0;
    for (int32_t k = 0; k < slice->regions; k++) {
        cage_bounds_none(&slice->region[k].bounds);
        slice->region[k].first = slice->orthoballs;
        slice->orthoballs += k == CAGE_OUTSIDE ? 0 : slice->region[k].size;
        slice->region[k].size = k == CAGE_OUTSIDE ? slice->region[k].size : 0;
    }
    slice->orthoball = cage_arena_take(arena, (size_t)slice->orthoballs, sizeof *slice->orthoball);
    if (!slice->orthoball)
        return CAGE_ERROR_MEMORY;
    for (int32_t s = 0; s < slice->t.simplices; s++) {
        struct cage_bounds bounds;
        if (slice->label[s] <= CAGE_OUTSIDE)
            continue;
        struct cage_region *region = &slice->region[slice->label[s]];
        struct cage_orthoball *ball = &slice->orthoball[region->first + region->size++];
        cage_orthoball_of(&slice->t, s, ball);
        cage_bounds_of(&slice->t, ball, &bounds);
        cage_bounds_add(slice->t.dim, &region->bounds, &bounds);
    }
    return CAGE_OK;
}

/* The top of the balls' bounding box is off every ball: centres and radii add up to less than CAGE_REACH. */
static void find_outside_point(const struct cage_slice *slice)
{
    int32_t top = 0;
    for (int32_t i = slice->t.dim + 1; i < slice->t.sites; i++) {
        int32_t y = slice->t.site[i].y + slice->t.site[i].r + 1;
        top = y > top ? y : top;
    }
    struct cage_region *outside = &slice->region[CAGE_OUTSIDE];
    outside->known = 1;
    outside->point[0] = outside->point[2] = 0;
    outside->point[1] = top;
}

static size_t padded(size_t bytes) { return (bytes + CAGE_ALIGN - 1) / CAGE_ALIGN * CAGE_ALIGN; }

/* Of the arrays, as they are packed. */
static size_t bytes_of(const struct cage_slice *s)
{
    return padded((size_t)s->t.sites * sizeof *s->t.site) + padded((size_t)s->t.sites * sizeof *s->t.ball) +
           padded((size_t)s->t.simplices * sizeof *s->t.simplex) + padded((size_t)s->t.simplices * sizeof *s->label) +
           padded((size_t)s->parts * sizeof *s->part) + padded((size_t)s->regions * sizeof *s->region) +
           padded((size_t)s->orthoballs * sizeof *s->orthoball);
}

/* Copy an array to *at, which moves on. */
static void *pack(unsigned char **at, const void *from, int32_t count, size_t size)
{
    void *to = *at;
    memcpy(to, from, (size_t)count * size);
    *at += padded((size_t)count * size);
    return to;
}

void cage_slice_pack(const struct cage_slice *slice, void *block, struct cage_slice *out)
{
    unsigned char *at = block;
    *out = *slice;
    out->t.site = pack(&at, slice->t.site, slice->t.sites, sizeof *slice->t.site);
    out->t.ball = pack(&at, slice->t.ball, slice->t.sites, sizeof *slice->t.ball);
    out->t.simplex = pack(&at, slice->t.simplex, slice->t.simplices, sizeof *slice->t.simplex);
    out->label = pack(&at, slice->label, slice->t.simplices, sizeof *slice->label);
    out->part = pack(&at, slice->part, slice->parts, sizeof *slice->part);
    out->region = pack(&at, slice->region, slice->regions, sizeof *slice->region);
    out->orthoball = pack(&at, slice->orthoball, slice->orthoballs, sizeof *slice->orthoball);
}

static int32_t find_regions(struct cage_arena *arena, const struct cage_components *components, struct cage_slice *out)
{
    int32_t largest = 0;
    out->label = components->label;
    out->regions = components->count;
    out->region = cage_arena_take(arena, (size_t)components->count, sizeof *out->region);
    if (!out->region)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = out->t.dim + 1; i < out->t.sites; i++)
        largest = out->t.site[i].r > largest ? out->t.site[i].r : largest;
    for (int32_t k = 0; k < components->count; k++) {
        out->region[k].deep = components->deep[k];
        out->region[k].size = 0;
        if (k != CAGE_OUTSIDE)
            find_point(out, k, largest);
    }
    find_outside_point(out);
    for (int32_t s = 0; s < out->t.simplices; s++)
        if (out->label[s] != CAGE_COVERED)
            out->region[out->label[s]].size++;
    return CAGE_OK;
}

/* The balls and their components, without those that are hidden. */
static int32_t triangulate(struct cage_arena *arena, const struct cage_side *side, const cage_ball *ball, int32_t count,
                           struct cage_slice *out, struct cage_components *components)
{
    int32_t error = cage_delaunay(arena, side->shortcuts, side->dim, ball, count, &out->t);
    if (error == CAGE_OK)
        error = cage_delaunay_drop_hidden(arena, &out->t);
    return error == CAGE_OK ? cage_components(arena, &out->t, components) : error;
}

static int32_t make(struct cage_arena *arena, const struct cage_side *side, const struct cage_rotations *rotations,
                    const struct cage_corners *corners, struct cage_slice *out)
{
    size_t pairs = (size_t)side->objects * (size_t)side->obstacles;
    out->parts = side->objects;
    out->part = cage_arena_take(arena, (size_t)side->objects, sizeof *out->part);
    cage_ball *ball = cage_arena_take(arena, pairs, sizeof *ball);
    int32_t *of = cage_arena_take(arena, pairs, sizeof *of);
    if (!out->part || !ball || !of)
        return CAGE_ERROR_MEMORY;
    place_parts(side, rotations, corners, out->part);
    int32_t count = collide(side, out->part, ball, of);
    struct cage_raster raster;
    out->balls = count;
    int32_t error = side->shortcuts ? side->shortcuts->prune(arena, side->dim, ball, of, &count, &raster) : CAGE_OK;
    if (error != CAGE_OK)
        return error;
    out->inserted = count;
    out->whole = count == out->balls;
    struct cage_components components;
    size_t mark = arena->used;
    error = triangulate(arena, side, ball, count, out, &components);
    if (error == CAGE_OK && !side->shortcuts) {
        int32_t kept = cage_border_first(&out->t, &components, ball, of, count);
        if (kept < count) {
            out->whole = false;
            cage_arena_release(arena, mark);
            out->inserted += kept;
            error = triangulate(arena, side, ball, kept, out, &components);
            if (error == CAGE_OK)
                error = cage_border_drop(arena, &out->t, ball, kept, count, &components);
        }
    }
    if (error != CAGE_OK)
        return error;
    for (int32_t i = side->dim + 1; i < out->t.sites; i++)
        out->t.ball[i] = of[out->t.ball[i]];
    if (side->shortcuts)
        error = side->shortcuts->drop_phantoms(arena, &out->t, &raster, &components);
    if (error == CAGE_OK)
        error = find_regions(arena, &components, out);
    if (error == CAGE_OK)
        error = find_orthoballs(arena, out);
    if (error == CAGE_OK)
        out->bytes = bytes_of(out);
    return error;
}

int32_t cage_slice_make(struct cage_arena *arena, const struct cage_side *side, const struct cage_rotations *rotations,
                        struct cage_slice *out)
{
    return cage_slice_make_within(arena, side, rotations, NULL, out);
}

int32_t cage_slice_make_within(struct cage_arena *arena, const struct cage_side *side, const struct cage_rotations *rotations,
                               const struct cage_corners *corners, struct cage_slice *out)
{
    size_t mark = arena->used;
    int32_t error = make(arena, side, rotations, corners, out);
    if (error != CAGE_OK)
        cage_arena_release(arena, mark);
    return error;
}
