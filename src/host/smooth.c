/* smooth.c: a path made short and smooth by descent in the metric A = K'K, kept only where the check certifies it.
 *
 * After CHOMP (Ratliff, Zucker, Bagnell, Srinivasa, "CHOMP: Gradient Optimization Techniques for Efficient Motion Planning",
 * ICRA 2009): stations between two fixed ends; the cost is that of steps and bends, and of balls nearer than a band; A's inverse
 * makes a step of its gradient, so that a push at one station bends the path around it. Turns are vectors of the world's
 * frame, applied on the manifold. Nothing here is believed: what comes out passes the check, or is dropped. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "smooth.h"

#define FEWEST 48        /* stations, ends included */
#define MOST 160
#define SPACING 0.1      /* of the object's radius, where that is within these */
#define STIFFNESS 1.0    /* of bends, against steps */
#define ROWS 4           /* on the grid, for each step between stations */
#define ROUNDS 24        /* with another weight of the obstacles, or another band, each */
#define STEPS 250        /* of descent in a round */
#define BAND 0.08        /* of the object's radius: distances below are paid for; it shrinks from round to round */
#define SHRINK 0.7
#define PUSH 1.7
#define IDLE 4           /* rounds without a gain, after which there is none */
#define ROUNDING 1e-6    /* a path as short as another but for this part */
#define WORTHWHILE 1e-4  /* a path shorter by less than this part is not another one */

/* Lengths are in radii of the object. */
typedef struct band {
    const host_answer *answer;
    const cage_pose *first, *last;
    smooth_metric *metric;
    way_near *near;
    way_station *station, *trial, *listed; /* now, tried, and as they were when near pairs were looked for */
    double *gradient, *step;               /* six columns of stations - 2 numbers */
    double radius, width, weight, pace, slack;
    int stations;
    cage_pose *row;
    int32_t rows;
} band;

static void free_band(band *b)
{
    smooth_metric_free(b->metric);
    way_near_free(b->near);
    free(b->station);
    free(b->gradient);
    free(b->row);
}

/* Detours go first: from each station straight to the farthest that one certified leg leads to, halving. -1: no memory. */
static int take_short_cuts(band *b)
{
    cage_pose *path = malloc(2 * (size_t)b->stations * sizeof *path), *kept;
    int at = 0, count = 1, n;

    if (path == NULL)
        return -1;
    kept = path + b->stations;
    for (n = 0; n < b->stations; n++)
        way_pose(&b->station[n], b->answer->query->dim, &path[n]);
    kept[0] = path[0];
    while (at + 1 < b->stations) {
        int to = b->stations - 1;

        while (to > at + 1 && !way_leg(b->answer, &path[at], &path[to]))
            to = at + (to - at) / 2;
        kept[count++] = path[at = to];
    }
    way_resample(kept, count, b->radius, b->station, b->stations);
    free(path);
    return 0;
}

static int make_band(band *b, const host_answer *answer, const cage_pose *path, int32_t count)
{
    const double radius = way_radius(answer), wanted = way_length(path, count, radius) / radius / SPACING;
    const int stations = wanted < FEWEST ? FEWEST : wanted > MOST ? MOST : (int)wanted;
    const size_t n = (size_t)stations;

    memset(b, 0, sizeof *b);
    b->answer = answer;
    b->first = &path[0];
    b->last = &path[count - 1];
    b->radius = radius;
    b->stations = stations;
    b->rows = ROWS * (stations - 1) + 1;
    b->station = malloc(3 * n * sizeof *b->station);
    b->gradient = malloc(12 * n * sizeof *b->gradient);
    b->row = malloc((size_t)b->rows * sizeof *b->row);
    b->metric = smooth_metric_make(stations - 2, STIFFNESS);
    if (b->station == NULL || b->gradient == NULL || b->row == NULL || b->metric == NULL)
        return -1;
    b->trial = b->station + n;
    b->listed = b->trial + n;
    b->step = b->gradient + 6 * n;
    way_resample(path, count, radius, b->station, stations);
    return take_short_cuts(b);
}

/* ---- cost and gradient ------------------------------------------------------------------------------ */

static double *of(double *columns, const band *b, int station, int k)
{
    return &columns[k * (b->stations - 2) + station - 1];
}

/* How far the object moves at most from one station to the other, in grid units. */
static double moved(const band *b, const way_station *from, const way_station *to)
{
    double turn[3], way = 0, angle = 0;
    int k;

    way_turn(from->q, to->q, turn);
    for (k = 0; k < 3; k++) {
        way += (to->x[k] - from->x[k]) * (to->x[k] - from->x[k]);
        angle += turn[k] * turn[k];
    }
    return sqrt(way) + b->radius * sqrt(angle);
}

/* Near pairs are looked for again when something may have come near meanwhile. */
static int look_around(band *b, const way_station *station)
{
    int n, stale = b->near == NULL;

    for (n = 0; n < b->stations && !stale; n++)
        stale = moved(b, &b->listed[n], &station[n]) > b->slack;
    if (!stale)
        return 0;
    way_near_free(b->near);
    memcpy(b->listed, station, (size_t)b->stations * sizeof *station);
    b->near = way_near_find(b->answer, station, b->stations, b->width + b->slack);
    return b->near != NULL ? 0 : -1;
}

/* The cost; its gradient where that is wanted. Negative: no memory. */
static double cost_of(band *b, const way_station *s, double *gradient)
{
    double cost = 0, unused = INFINITY;
    int n, k;

    if (look_around(b, s) < 0)
        return -1;
    if (gradient != NULL)
        memset(gradient, 0, 6 * (size_t)(b->stations - 2) * sizeof *gradient);
    for (n = 0; n + 1 < b->stations; n++) {
        double turn[3];

        way_turn(s[n].q, s[n + 1].q, turn);
        for (k = 0; k < 6; k++) {
            const double step = k < 3 ? (s[n + 1].x[k] - s[n].x[k]) / b->radius : turn[k - 3];

            cost += step * step / 2;
            if (gradient != NULL && n > 0)
                *of(gradient, b, n, k) -= step;
            if (gradient != NULL && n + 2 < b->stations)
                *of(gradient, b, n + 1, k) += step;
        }
    }
    for (n = 1; n + 1 < b->stations; n++) {
        double push[6] = { 0, 0, 0, 0, 0, 0 };

        cost += b->weight * way_near_cost(b->near, n, &s[n], b->width, push, &unused) / b->radius;
        for (k = 0; k < 6 && gradient != NULL; k++)
            *of(gradient, b, n, k) += b->weight * (k < 3 ? push[k] : push[k] / b->radius);
        for (k = 0; k < 3; k++) {
            const double bend = (s[n - 1].x[k] - 2 * s[n].x[k] + s[n + 1].x[k]) / b->radius;

            cost += STIFFNESS * STIFFNESS * bend * bend / 2;
            if (gradient == NULL)
                continue;
            *of(gradient, b, n, k) -= 2 * STIFFNESS * STIFFNESS * bend;
            if (n > 1)
                *of(gradient, b, n - 1, k) += STIFFNESS * STIFFNESS * bend;
            if (n + 2 < b->stations)
                *of(gradient, b, n + 1, k) += STIFFNESS * STIFFNESS * bend;
        }
    }
    return cost;
}

/* ---- descent ---------------------------------------------------------------------------------------- */

static void take_step(const band *b, way_station *out)
{
    int n, k;

    memcpy(out, b->station, (size_t)b->stations * sizeof *out);
    for (n = 1; n + 1 < b->stations; n++) {
        double turn[3];

        for (k = 0; k < 3; k++) {
            out[n].x[k] -= b->pace * b->radius * *of(b->step, b, n, k);
            turn[k] = -b->pace * *of(b->step, b, n, 3 + k);
        }
        way_apply(turn, b->station[n].q, out[n].q);
    }
}

/* Steps that lower the cost, by a pace that grows while they do. -1: no memory. */
static int descend(band *b)
{
    double cost = cost_of(b, b->station, b->gradient);
    int n;

    for (n = 0; n < STEPS && cost >= 0 && b->pace > 1e-9; n++) {
        double after;

        if (smooth_metric_solve(b->metric, b->gradient, b->step, 6) < 0)
            return -1;
        take_step(b, b->trial);
        after = cost_of(b, b->trial, NULL);
        if (after < 0)
            return -1;
        if (after >= cost) {
            b->pace /= 2;
            continue;
        }
        memcpy(b->station, b->trial, (size_t)b->stations * sizeof *b->station);
        b->pace = fmin(1, b->pace * 1.2);
        cost = cost_of(b, b->station, b->gradient);
    }
    return cost < 0 ? -1 : 0;
}

/* The least gap at stations between the ends; look_around has been done. */
static double least_gap(const band *b)
{
    double least = INFINITY, unused[6] = { 0 };
    int n;

    for (n = 1; n + 1 < b->stations; n++)
        (void)way_near_cost(b->near, n, &b->station[n], b->width, unused, &least);
    return least;
}

enum { BROKEN = -1, COLLIDES, TIGHT, CERTIFIED, SHORTER };

/* Keep the rows if they are certified, and shorter than what is kept, or as short as the path that was found. TIGHT: it is clear
 * at the stations, but not certified in between; BROKEN: no memory. */
static int keep(band *b, host_way *way)
{
    double deviation, length;
    cage_pose *kept;
    int certified;

    if (least_gap(b) <= 0)
        return COLLIDES;
    way_rows(b->station, b->stations, b->first, b->last, b->answer->query->dim, b->row, b->rows);
    length = way_length(b->row, b->rows, b->radius);
    if (way->smooth && length > way->length * (1 - WORTHWHILE))
        return CERTIFIED; /* whether it is or not: it gains nothing */
    certified = way_certify(b->answer, b->row, b->rows, &deviation);
    if (certified < 1)
        return certified < 0 ? BROKEN : TIGHT;
    if (way->count > 0 && length > way->length * (1 + ROUNDING))
        return CERTIFIED;
    kept = realloc(way->pose, (size_t)b->rows * sizeof *kept);
    if (kept == NULL)
        return BROKEN;
    memcpy(kept, b->row, (size_t)b->rows * sizeof *kept);
    way->pose = kept;
    way->count = b->rows;
    way->smooth = 1;
    way->length = length;
    way->deviation = deviation;
    return SHORTER;
}

int host_smooth(const host_answer *answer, const cage_pose *path, int32_t count, int certified, host_way *way, host_error *error)
{
    band b;
    int round, fine, done, idle = 0;

    memset(way, 0, sizeof *way);
    way->found_length = way_length(path, count, way_radius(answer));
    if (certified) {
        way->pose = malloc((size_t)count * sizeof *way->pose);
        if (way->pose == NULL)
            return host_fail(error, HOST_MEMORY, "no memory for the path");
        memcpy(way->pose, path, (size_t)count * sizeof *way->pose);
        way->count = count;
        way->length = way->found_length;
    }
    fine = make_band(&b, answer, path, count) == 0;
    b.width = BAND * b.radius;
    b.slack = b.width;
    b.weight = 0.2 * way->found_length / b.radius / b.stations;
    for (round = 0; round < ROUNDS && idle < IDLE && fine && way->found_length > 0; round++) {
        b.pace = 0.02;
        fine = descend(&b) == 0;
        done = fine ? keep(&b, way) : BROKEN;
        fine = done != BROKEN;
        idle = done == CERTIFIED ? idle + 1 : 0;
        if (done == COLLIDES)
            b.weight *= PUSH;
        else
            b.width *= SHRINK; /* closer to the obstacles, or with less of a push where it is narrow */
    }
    free_band(&b);
    if (fine)
        return HOST_OK;
    host_free_way(way);
    return host_fail(error, HOST_MEMORY, "no memory to smooth the path");
}
