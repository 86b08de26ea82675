/* way.c: a path as stations in doubles and as rows on the grid: its length, its certificate, its file. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "smooth.h"

/* ---- rotations ------------------------------------------------------------------------------------ */

static void multiply(const double a[4], const double b[4], double out[4])
{
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    out[2] = a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3];
    out[3] = a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1];
}

static void normalise(double q[4])
{
    double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    int k;

    for (k = 0; k < 4; k++)
        q[k] /= size;
}

void way_turn(const double from[4], const double to[4], double turn[3])
{
    const double back[4] = { from[0], -from[1], -from[2], -from[3] };
    double r[4], sine, factor;
    int k;

    multiply(to, back, r);
    sine = sqrt(r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    factor = sine < 1e-12 ? 2 : 2 * atan2(sine, fabs(r[0])) / sine;
    for (k = 0; k < 3; k++)
        turn[k] = (r[0] < 0 ? -factor : factor) * r[1 + k];
}

void way_apply(const double turn[3], const double q[4], double out[4])
{
    const double angle = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    const double factor = angle < 1e-12 ? 0.5 : sin(angle / 2) / angle;
    const double by[4] = { cos(angle / 2), factor * turn[0], factor * turn[1], factor * turn[2] };

    multiply(by, q, out);
    normalise(out);
}

/* ---- stations ------------------------------------------------------------------------------------- */

void way_station_of(const cage_pose *pose, way_station *out)
{
    int k;

    for (k = 0; k < 3; k++)
        out->x[k] = pose->x[k];
    for (k = 0; k < 4; k++)
        out->q[k] = pose->q[k];
    normalise(out->q);
}

void way_between(const way_station *a, const way_station *b, double t, way_station *out)
{
    double turn[3];
    int k;

    way_turn(a->q, b->q, turn);
    for (k = 0; k < 3; k++) {
        out->x[k] = a->x[k] + t * (b->x[k] - a->x[k]);
        turn[k] *= t;
    }
    way_apply(turn, a->q, out->q);
}

double way_radius(const host_answer *answer)
{
    const cage_shape *object = &answer->grid->scene.object;
    const int32_t *pivot = answer->result->pivot;
    double most = 1;
    int32_t i;

    for (i = 0; i < object->outer_count; i++) {
        const double x = object->outer[i].x - pivot[0], y = object->outer[i].y - pivot[1], z = object->outer[i].z - pivot[2];

        most = fmax(most, sqrt(x * x + y * y + z * z) + object->outer[i].r);
    }
    return most;
}

static double leg_length(const way_station *a, const way_station *b, double radius)
{
    double turn[3], square = 0;
    int k;

    way_turn(a->q, b->q, turn);
    for (k = 0; k < 3; k++)
        square += (b->x[k] - a->x[k]) * (b->x[k] - a->x[k]) + radius * radius * turn[k] * turn[k];
    return sqrt(square);
}

double way_length(const cage_pose *path, int32_t count, double radius)
{
    way_station a, b;
    double length = 0;
    int32_t i;

    for (i = 0; i + 1 < count; i++) {
        way_station_of(&path[i], &a);
        way_station_of(&path[i + 1], &b);
        length += leg_length(&a, &b, radius);
    }
    return length;
}

void way_resample(const cage_pose *path, int32_t count, double radius, way_station *station, int stations)
{
    const double length = way_length(path, count, radius);
    way_station a, b;
    double passed = 0;
    int32_t i;
    int n = 1;

    way_station_of(&path[0], &station[0]);
    for (i = 0; i + 1 < count; i++) {
        double leg;

        way_station_of(&path[i], &a);
        way_station_of(&path[i + 1], &b);
        leg = leg_length(&a, &b, radius);
        for (; n < stations - 1 && leg > 0 && length * n / (stations - 1) <= passed + leg; n++)
            way_between(&a, &b, (length * n / (stations - 1) - passed) / leg, &station[n]);
        passed += leg;
    }
    way_station_of(&path[count - 1], &a);
    for (; n < stations; n++)
        station[n] = a;
}

/* ---- rows on the grid ------------------------------------------------------------------------------- */

/* The slope at a station of a cubic through all of them, for steps of 1. */
static double slope(const way_station *station, int stations, int i, int k)
{
    if (i == 0 || i == stations - 1)
        return station[i == 0 ? 1 : i].x[k] - station[i == 0 ? 0 : i - 1].x[k];
    return (station[i + 1].x[k] - station[i - 1].x[k]) / 2;
}

void way_pose(const way_station *at, int32_t dim, cage_pose *pose)
{
    const double entry = dim == 2 ? CAGE_QUATERNION_2D : CAGE_QUATERNION_3D;
    int k;

    for (k = 0; k < 3; k++)
        pose->x[k] = (int32_t)lrint(fmax(INT32_MIN, fmin(INT32_MAX, at->x[k])));
    for (k = 0; k < 4; k++)
        pose->q[k] = dim == 2 && (k == 1 || k == 2) ? 0 : (int32_t)lrint(at->q[k] * entry);
}

void way_rows(const way_station *station, int stations, const cage_pose *first, const cage_pose *last, int32_t dim,
              cage_pose *row, int32_t rows)
{
    int32_t n;

    for (n = 1; n < rows - 1; n++) {
        const double along = (double)n * (stations - 1) / (rows - 1);
        int i = (int)along, k;
        double t, u;
        way_station at;

        i = i > stations - 2 ? stations - 2 : i;
        t = along - i;
        u = 1 - t;
        way_between(&station[i], &station[i + 1], t, &at);
        for (k = 0; k < 3; k++) {
            const double step = station[i + 1].x[k] - station[i].x[k];

            at.x[k] += t * u * (u * (slope(station, stations, i, k) - step) - t * (slope(station, stations, i + 1, k) - step));
        }
        way_pose(&at, dim, &row[n]);
    }
    row[0] = *first;
    row[rows - 1] = *last;
}

/* Twice the slope at a row. */
static double row_slope(const cage_pose *row, int32_t rows, int32_t i, int k)
{
    if (i == 0)
        return 2 * ((double)row[1].x[k] - row[0].x[k]);
    if (i == rows - 1)
        return 2 * ((double)row[i].x[k] - row[i - 1].x[k]);
    return (double)row[i + 1].x[k] - row[i - 1].x[k];
}

/* On a leg the cubic is off the straight leg, at the same time t, by t (1-t) ((1-t) (m0 - d) - t (m1 - d)), m the slopes at its
 * ends and d the leg; t (1-t)^2 is at most 4/27. */
static double deviation_of(const cage_pose *row, int32_t rows)
{
    double most = 0;
    int32_t i;
    int k;

    for (i = 0; i + 1 < rows; i++) {
        double first = 0, second = 0;

        for (k = 0; k < 3; k++) {
            const double leg = (double)row[i + 1].x[k] - row[i].x[k];
            const double a = row_slope(row, rows, i, k) / 2 - leg, b = row_slope(row, rows, i + 1, k) / 2 - leg;

            first += a * a;
            second += b * b;
        }
        most = fmax(most, 4.0 / 27 * (sqrt(first) + sqrt(second)));
    }
    return most;
}

void way_at(const cage_pose *row, int32_t rows, int curve, int32_t i, double t, way_station *out)
{
    const double u = 1 - t;
    way_station a, b;
    int k;

    way_station_of(&row[i], &a);
    way_station_of(&row[i + 1], &b);
    way_between(&a, &b, t, out);
    for (k = 0; curve && k < 3; k++) {
        const double leg = b.x[k] - a.x[k];

        out->x[k] += t * u * (u * (row_slope(row, rows, i, k) / 2 - leg) - t * (row_slope(row, rows, i + 1, k) / 2 - leg));
    }
}

/* The cubic with slopes m and n at the ends of the leg d has as its velocity the quadratic Bezier curve of m, 3 d - m - n and n,
 * which is in their hull: no longer than the longest of them. The turn goes at a constant rate. */
double way_rate(const cage_pose *row, int32_t rows, int curve, int32_t i, double radius)
{
    double leg = 0, first = 0, middle = 0, last = 0, turn[3];
    way_station a, b;
    int k;

    way_station_of(&row[i], &a);
    way_station_of(&row[i + 1], &b);
    way_turn(a.q, b.q, turn);
    for (k = 0; k < 3; k++) {
        const double d = b.x[k] - a.x[k], m = row_slope(row, rows, i, k) / 2, n = row_slope(row, rows, i + 1, k) / 2;

        leg = hypot(leg, d);
        first = hypot(first, m);
        middle = hypot(middle, 3 * d - m - n);
        last = hypot(last, n);
    }
    return (curve ? fmax(fmax(first, middle), last) : leg) + radius * hypot(hypot(turn[0], turn[1]), turn[2]);
}

/* A pose of the user's whose pivot is at that pose of the pivot. */
static void to_user(const cage_pose *pose, const int32_t pivot[3], cage_pose *user)
{
    host_pose at;
    int k;

    host_from_grid(pose, pivot, 3, 1, &at);
    *user = *pose;
    for (k = 0; k < 3; k++)
        user->x[k] = (int32_t)lrint(fmax(INT32_MIN, fmin(INT32_MAX, at.x[k])));
}

int way_leg(const host_answer *answer, const cage_pose *from, const cage_pose *to)
{
    const int32_t *pivot = answer->result->pivot;
    const cage_pose leg[2] = { *from, *to };
    cage_pose start, goal;

    to_user(from, pivot, &start);
    to_user(to, pivot, &goal);
    return cage_path_check(&answer->grid->scene, &start, &goal, pivot, leg, 2) == 1;
}

int way_certify(const host_answer *answer, const cage_pose *row, int32_t rows, double *deviation)
{
    const host_grid *grid = answer->grid;
    const int32_t *pivot = answer->result->pivot;
    cage_scene grown = grid->scene;
    cage_ball *ball;
    cage_pose goal = grid->goal;
    int32_t i, more;
    int free_at_all;

    *deviation = deviation_of(row, rows);
    if (!(*deviation < 1 << 20))
        return 0;
    more = (int32_t)ceil(*deviation + 0.001); /* the doubles are exact to much less */
    ball = malloc(((size_t)grown.obstacles.outer_count + 1) * sizeof *ball);
    if (ball == NULL)
        return -1;
    for (i = 0; i < grown.obstacles.outer_count; i++) {
        ball[i] = grown.obstacles.outer[i];
        ball[i].r += more; /* the check refuses what no longer fits the grid */
    }
    grown.obstacles.outer = ball;
    if (!answer->query->has_goal)
        to_user(&row[rows - 1], pivot, &goal);
    free_at_all = cage_path_check(&grown, &grid->start, &goal, pivot, row, rows) == 1;
    if (free_at_all && !answer->query->has_goal) /* and its end is beyond all obstacles */
        free_at_all = cage_path_check(&grid->scene, &grid->start, NULL, pivot, row, rows) == 1;
    free(ball);
    return free_at_all;
}

/* ---- the file --------------------------------------------------------------------------------------- */

int host_write_way(const char *path, const host_answer *answer, const host_way *way, host_error *error)
{
    const int32_t dim = answer->query->dim, none[3] = { 0, 0, 0 };
    FILE *file = fopen(path, "w");
    double before = 0, heading = 0, last[4] = { 0, 0, 0, 0 }, sign;
    int32_t i;
    int k, fine = file != NULL;

    if (fine)
        (void)fprintf(file, dim == 2 ? "t,x,y,degrees,pivot_x,pivot_y,curve\n"
                                        : "t,x,y,z,qw,qx,qy,qz,pivot_x,pivot_y,pivot_z,curve\n");
    for (i = 0; fine && i < way->count; i++) {
        host_pose at, pivot;

        host_from_grid(&way->pose[i], answer->result->pivot, dim, answer->grid->unit, &at);
        host_from_grid(&way->pose[i], none, dim, answer->grid->unit, &pivot);
        if (dim == 2) { /* degrees go on beyond 180: from row to row it is always the shorter way */
            heading = i == 0 ? at.degrees : heading + remainder(at.degrees - before, 360);
            before = at.degrees;
            (void)fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%d\n", way->count > 1 ? (double)i / (way->count - 1) : 0.0,
                          at.x[0], at.x[1], heading, pivot.x[0], pivot.x[1], way->smooth);
        } else { /* q and -q are the same: the one nearer to that of the row before */
            sign = last[0] * at.q[0] + last[1] * at.q[1] + last[2] * at.q[2] + last[3] * at.q[3] < 0 ? -1 : 1;
            for (k = 0; k < 4; k++)
                last[k] = at.q[k] = sign * at.q[k];
            (void)fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%d\n",
                          way->count > 1 ? (double)i / (way->count - 1) : 0.0, at.x[0], at.x[1], at.x[2], at.q[0], at.q[1],
                          at.q[2], at.q[3], pivot.x[0], pivot.x[1], pivot.x[2], way->smooth);
        }
    }
    if (file != NULL && ferror(file))
        fine = 0;
    if (file != NULL && fclose(file) != 0)
        fine = 0;
    return fine ? HOST_OK : host_fail(error, HOST_BAD_INPUT, "--path: %.600s cannot be written: %.200s", path, strerror(errno));
}

void host_free_way(host_way *way)
{
    free(way->pose);
    memset(way, 0, sizeof *way);
}
