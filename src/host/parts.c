/* parts.c: a path checked with the true shapes by libccd: a check by samples between which nothing is skipped, no proof.
 *
 * At a sample all pairs of parts are farther apart than some clearance c. From there to the next sample no point of the object
 * moves farther than c (way_rate bounds its speed): each is then still off all obstacles, so there is no collision between the two.
 * What is believed is libccd's answer, given in doubles and by iteration; so this proves nothing. Shapes are handed to it in
 * lengths of a part's reach, its tolerances being absolute, and it is asked by MPR, as its GJK misjudges shapes that nearly touch. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <ccd/ccd.h>

#include "parts.h"

#define ITERATIONS 200   /* that libccd may take for one pair */
#define TOLERANCE 1e-6   /* of its answers, and what is asked for beyond the clearance */
#define FINEST 1e-3      /* clearance needed, in reaches of the object; less than it is "too close to tell" */
#define WIDEST 1.0       /* clearance asked for first */
#define MOST_POSES 2000000L
#define MOST_PLACES 1000

typedef struct solid {
    const host_part *part;
    double x[3], q[4];
    double scale; /* libccd's lengths for one of ours */
    double grown; /* by so much, in libccd's lengths */
} solid;

/* The state of one check: the object's parts about its pivot, obstacles, all in the user's lengths. */
typedef struct checker {
    const host_answer *answer;
    const host_parts *parts;
    host_part *moved; /* the object's parts at a pose */
    double pivot[3];
    double reach;     /* of the object from its pivot */
    const cage_pose *row;
    int32_t rows;
    int curve;
    parts_check *check;
} checker;

int host_parts_available(void)
{
    return 1;
}

const char *host_parts_name(void)
{
    return "libccd";
}

/* ---- shapes for libccd ------------------------------------------------------------------------------- */

static void support_of(const host_part *part, const double dir[3], double out[3])
{
    const int axis = part->axis;
    double across = 0, along = 0;
    int32_t i, best = 0;
    int k;

    for (k = 0; k < 3; k++)
        out[k] = 0;
    if (part->shape == PART_HULL) {
        double most = -INFINITY;

        for (i = 0; i < part->vertices; i++) {
            const double *v = part->vertex[i], far = v[0] * dir[0] + v[1] * dir[1] + v[2] * dir[2];

            best = far > most ? i : best;
            most = fmax(most, far);
        }
        memcpy(out, part->vertex[best], 3 * sizeof out[0]);
        return;
    }
    for (k = 0; k < 3; k++) {
        along = hypot(along, dir[k]);
        across = hypot(across, k == axis ? 0 : dir[k]);
        out[k] = part->shape == PART_BOX ? copysign(part->size[k], dir[k]) : 0;
    }
    if (part->shape == PART_BOX)
        return;
    for (k = 0; k < 3; k++)
        if (part->shape == PART_CAPSULE)
            out[k] = along > 0 ? part->size[0] * dir[k] / along : 0;
        else
            out[k] = k != axis && across > 0 ? part->size[0] * dir[k] / across : 0;
    out[axis] += copysign(part->size[1], dir[axis]);
}

static void support(const void *object, const ccd_vec3_t *dir, ccd_vec3_t *out)
{
    const solid *s = object;
    const double d[3] = { ccdVec3X(dir), ccdVec3Y(dir), ccdVec3Z(dir) };
    const double size = hypot(hypot(d[0], d[1]), d[2]);
    double local[3], point[3], world[3];
    int k;

    parts_turn_back(s->q, d, local);
    support_of(s->part, local, point);
    parts_turn(s->q, point, world);
    for (k = 0; k < 3; k++)
        world[k] = (world[k] + s->x[k]) * s->scale + (size > 0 ? s->grown * d[k] / size : 0);
    ccdVec3Set(out, world[0], world[1], world[2]);
}

static void centre(const void *object, ccd_vec3_t *out)
{
    const solid *s = object;
    double world[3];
    int k;

    parts_turn(s->q, s->part->centre, world);
    for (k = 0; k < 3; k++)
        world[k] = (world[k] + s->x[k]) * s->scale;
    ccdVec3Set(out, world[0], world[1], world[2]);
}

static void set_up(ccd_t *ccd)
{
    CCD_INIT(ccd);
    ccd->support1 = ccd->support2 = support;
    ccd->center1 = ccd->center2 = centre;
    ccd->max_iterations = ITERATIONS;
    ccd->mpr_tolerance = TOLERANCE / 4;
}

/* Both about the first one's place, so that far from the origin nothing is lost. */
static void make_pair(const host_part *a, const host_part *b, double grown, solid pair[2])
{
    const host_part *part[2] = { a, b };
    int i, k;

    for (i = 0; i < 2; i++) {
        pair[i].part = part[i];
        for (k = 0; k < 3; k++)
            pair[i].x[k] = part[i]->x[k] - a->x[k];
        memcpy(pair[i].q, part[i]->q, sizeof pair[i].q);
        pair[i].scale = 1 / fmax(a->reach, 1e-300);
        pair[i].grown = i == 0 ? grown * pair[i].scale : 0;
    }
}

static double apart(const host_part *a, const host_part *b)
{
    double ca[3], cb[3];

    parts_turn(a->q, a->centre, ca);
    parts_turn(b->q, b->centre, cb);
    return hypot(hypot(ca[0] + a->x[0] - cb[0] - b->x[0], ca[1] + a->x[1] - cb[1] - b->x[1]), ca[2] + a->x[2] - cb[2] - b->x[2]);
}

int parts_closer(const host_part *a, const host_part *b, double than)
{
    solid pair[2];
    ccd_t ccd;

    if (apart(a, b) > a->reach + b->reach + than)
        return 0;
    set_up(&ccd);
    make_pair(a, b, than, pair);
    return ccdMPRIntersect(&pair[0], &pair[1], &ccd) != 0;
}

/* How deep two parts that overlap are in each other; 0 where libccd finds no depth. */
static double depth_of(const host_part *a, const host_part *b)
{
    ccd_real_t depth = 0;
    ccd_vec3_t dir, at;
    solid pair[2];
    ccd_t ccd;

    set_up(&ccd);
    make_pair(a, b, 0, pair);
    if (ccdMPRPenetration(&pair[0], &pair[1], &ccd, &depth, &dir, &at) != 0)
        return 0;
    return depth > 0 ? depth / pair[0].scale : 0;
}

/* ---- along a path ------------------------------------------------------------------------------------- */

/* The object's parts at a pose of the pivot, which is in grid units. */
static void place(const checker *c, const way_station *at)
{
    const double unit = c->answer->grid->unit;
    int32_t i;
    int k;

    for (i = 0; i < c->parts->count[0]; i++) {
        const host_part *part = &c->parts->part[0][i];
        double arm[3], turned[3];

        for (k = 0; k < 3; k++)
            arm[k] = part->x[k] - c->pivot[k];
        parts_turn(at->q, arm, turned);
        for (k = 0; k < 3; k++)
            c->moved[i].x[k] = at->x[k] * unit + turned[k];
        c->moved[i].q[0] = at->q[0] * part->q[0] - at->q[1] * part->q[1] - at->q[2] * part->q[2] - at->q[3] * part->q[3];
        for (k = 0; k < 3; k++)
            c->moved[i].q[1 + k] = at->q[0] * part->q[1 + k] + at->q[1 + k] * part->q[0] +
                                   at->q[1 + (k + 1) % 3] * part->q[1 + (k + 2) % 3] -
                                   at->q[1 + (k + 2) % 3] * part->q[1 + (k + 1) % 3];
    }
}

/* Is any part of the object, as it is placed, closer to an obstacle than that? *depth: of the deepest of those, if wanted. */
static int any_closer(const checker *c, double than, double *depth)
{
    int32_t i, j;
    int found = 0;

    for (i = 0; i < c->parts->count[0]; i++)
        for (j = 0; j < c->parts->count[1] && (!found || depth != NULL); j++)
            if (parts_closer(&c->moved[i], &c->parts->part[1][j], than)) {
                found = 1;
                if (depth != NULL)
                    *depth = fmax(*depth, depth_of(&c->moved[i], &c->parts->part[1][j]));
            }
    return found;
}

static int add_place(checker *c, int32_t leg, const way_station *at, int overlaps, double depth, int follows)
{
    parts_check *check = c->check;
    parts_place *last = check->places > 0 ? &check->place[check->places - 1] : NULL;

    if (last == NULL || !follows) {
        if (check->places == MOST_PLACES)
            return 0;
        if (check->place == NULL)
            check->place = malloc(MOST_PLACES * sizeof *check->place);
        if (check->place == NULL)
            return -1;
        last = &check->place[check->places++];
    } else if (overlaps < last->overlaps || (overlaps == last->overlaps && depth <= last->depth)) {
        return 0; /* not the worst of them */
    }
    last->overlaps = overlaps;
    last->depth = depth;
    last->leg = leg;
    way_pose(at, c->answer->query->dim, &last->at);
    return 0;
}

/* One sample: the clearance that there is for sure, halved from `tried` on; a place where there is not even the finest. What may
 * be gone until the next sample; negative: no memory. */
static double look(checker *c, int32_t leg, const way_station *at, double tried, int *follows)
{
    const double finest = c->check->finest, spare = TOLERANCE * c->reach;
    double depth = 0;
    int overlaps;

    place(c, at);
    c->check->poses++;
    for (; tried >= finest; tried /= 2)
        if (!any_closer(c, tried + spare, NULL)) {
            *follows = 0;
            c->check->least = fmin(c->check->least, tried);
            return tried;
        }
    c->check->least = 0;
    overlaps = any_closer(c, 0, &depth);
    if (add_place(c, leg, at, overlaps, depth, *follows) < 0)
        return -1;
    *follows = 1;
    return finest;
}

static int follow(checker *c)
{
    const double widest = WIDEST * c->reach, unit = c->answer->grid->unit;
    double t = 0, tried = widest, gone;
    way_station at;
    int32_t i;
    int follows = 0;

    c->check->least = widest;
    for (i = 0; i + 1 < c->rows; i++) {
        const double rate = way_rate(c->row, c->rows, c->curve, i, c->reach / unit) * unit;

        for (t = 0; t < 1 && c->check->poses < MOST_POSES; t += rate > 0 ? gone / rate : 1) { /* a next row is looked at anyway */
            way_at(c->row, c->rows, c->curve, i, t, &at);
            gone = look(c, i, &at, fmin(widest, 2 * tried), &follows);
            if (gone < 0)
                return -1;
            tried = gone;
        }
    }
    c->check->whole = c->check->poses < MOST_POSES;
    way_station_of(&c->row[c->rows - 1], &at);
    return look(c, c->rows - 2, &at, fmin(widest, 2 * tried), &follows) < 0 ? -1 : 0;
}

/* ---- all of it ---------------------------------------------------------------------------------------- */

static int check_path(checker *c)
{
    const host_answer *answer = c->answer;
    int32_t i;
    int k, code;

    if (answer->result->path_count > 1) {
        c->check->kind = 1;
        c->row = answer->result->path;
        c->rows = answer->result->path_count;
        c->curve = answer->way != NULL && answer->way->smooth;
    } else if (answer->candidate != NULL && answer->candidate->count > 1) {
        c->check->kind = 2;
        c->row = answer->candidate->pose;
        c->rows = answer->candidate->count;
    } else {
        return 0;
    }
    c->moved = malloc((size_t)c->parts->count[0] * sizeof *c->moved);
    if (c->moved == NULL)
        return -1;
    memcpy(c->moved, c->parts->part[0], (size_t)c->parts->count[0] * sizeof *c->moved);
    for (k = 0; k < 3; k++)
        c->pivot[k] = answer->result->pivot[k] * answer->grid->unit;
    for (i = 0; i < c->parts->count[0]; i++) {
        const host_part *part = &c->parts->part[0][i];
        double middle[3], far = 0;

        parts_turn(part->q, part->centre, middle);
        for (k = 0; k < 3; k++)
            far = hypot(far, middle[k] + part->x[k] - c->pivot[k]);
        c->reach = fmax(c->reach, far + part->reach);
    }
    c->check->finest = FINEST * c->reach;
    code = follow(c);
    free(c->moved);
    return code;
}

int host_check_parts(const host_answer *answer, const host_parts *parts, parts_check *check, host_error *error)
{
    const host_balls *balls[2] = { &answer->query->object, &answer->query->obstacles };
    const int32_t dim = answer->query->dim;
    checker c;
    int side;
    int32_t i;

    memset(check, 0, sizeof *check);
    memset(&c, 0, sizeof c);
    c.answer = answer;
    c.parts = parts;
    c.check = check;
    for (side = 0; side < 2; side++) {
        parts_cover *cover = &check->cover[side];

        for (i = 0; i < balls[side]->count; i++) {
            const host_ball *ball = &balls[side]->ball[i];

            if (parts_hold_ball(parts->part[side], parts->count[side], ball->x, ball->r, dim))
                continue;
            cover->first = cover->out == 0 ? i : cover->first;
            cover->out++;
        }
        cover->balls = balls[side]->count;
        parts_cover_by(parts->part[side], parts->count[side], balls[side], dim, cover);
    }
    return check_path(&c) == 0 ? HOST_OK : host_fail(error, HOST_MEMORY, "no memory to check a path with parts");
}

void host_free_check(parts_check *check)
{
    free(check->place);
    memset(check, 0, sizeof *check);
}
