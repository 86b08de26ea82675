/* clearance.c: how near the object's balls come to the obstacles' along a path, with gradients, by lists of near pairs. */
#include <math.h>
#include <stdlib.h>

#include "smooth.h"

typedef struct pair {
    int32_t object, obstacle;
} pair;

struct way_near {
    const cage_scene *scene;
    const int32_t *pivot;
    pair *item;
    size_t count, room;
    size_t *first; /* of each station, and of one more */
};

static void arm_of(const way_near *near, int32_t i, const double q[4], double arm[3])
{
    const cage_ball *ball = &near->scene->object.outer[i];
    const double y[3] = { ball->x - near->pivot[0], ball->y - near->pivot[1], ball->z - near->pivot[2] };
    double u[3];
    int k;

    for (k = 0; k < 3; k++)
        u[k] = 2 * (q[1 + (k + 1) % 3] * y[(k + 2) % 3] - q[1 + (k + 2) % 3] * y[(k + 1) % 3]);
    for (k = 0; k < 3; k++)
        arm[k] = y[k] + q[0] * u[k] + q[1 + (k + 1) % 3] * u[(k + 2) % 3] - q[1 + (k + 2) % 3] * u[(k + 1) % 3];
}

static int add_pair(way_near *near, int32_t object, int32_t obstacle)
{
    if (near->count == near->room) {
        const size_t room = 2 * near->room + 1024;
        pair *more = realloc(near->item, room * sizeof *more);

        if (more == NULL)
            return -1;
        near->item = more;
        near->room = room;
    }
    near->item[near->count].object = object;
    near->item[near->count++].obstacle = obstacle;
    return 0;
}

/* All pairs at a station: those of an obstacle too far away for any part of the object are passed over at once. */
static int add_station(way_near *near, const way_station *at, double within, double radius)
{
    const cage_shape *obstacles = &near->scene->obstacles;
    int32_t i, j;

    for (j = 0; j < obstacles->outer_count; j++) {
        const cage_ball *ball = &obstacles->outer[j];
        const double far[3] = { ball->x - at->x[0], ball->y - at->x[1], ball->z - at->x[2] };
        const double reach = radius + ball->r + within;

        if (far[0] * far[0] + far[1] * far[1] + far[2] * far[2] > reach * reach)
            continue;
        for (i = 0; i < near->scene->object.outer_count; i++) {
            const double touch = (double)ball->r + near->scene->object.outer[i].r + within;
            double arm[3], d[3];
            int k;

            arm_of(near, i, at->q, arm);
            for (k = 0; k < 3; k++)
                d[k] = far[k] - arm[k];
            if (touch > 0 && d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < touch * touch && add_pair(near, i, j) < 0)
                return -1;
        }
    }
    return 0;
}

way_near *way_near_find(const host_answer *answer, const way_station *station, int stations, double within)
{
    const double radius = way_radius(answer);
    way_near *near = calloc(1, sizeof *near);
    int n, fine = near != NULL;

    if (!fine)
        return NULL;
    near->scene = &answer->grid->scene;
    near->pivot = answer->result->pivot;
    near->first = calloc((size_t)stations + 1, sizeof *near->first);
    fine = near->first != NULL;
    for (n = 0; fine && n < stations; n++) {
        near->first[n] = near->count;
        fine = add_station(near, &station[n], within, radius) == 0;
        near->first[n + 1] = near->count;
    }
    if (!fine) {
        way_near_free(near);
        return NULL;
    }
    return near;
}

void way_near_free(way_near *near)
{
    if (near == NULL)
        return;
    free(near->item);
    free(near->first);
    free(near);
}

double way_near_cost(const way_near *near, int index, const way_station *at, double band, double push[6], double *least)
{
    double cost = 0, arm[3] = { 0, 0, 0 };
    int32_t placed = -1;
    size_t n;

    for (n = near->first[index]; n < near->first[index + 1]; n++) {
        const cage_ball *ball = &near->scene->obstacles.outer[near->item[n].obstacle];
        double d[3], distance, gap, force;
        int k;

        if (near->item[n].object != placed)
            arm_of(near, near->item[n].object, at->q, arm);
        placed = near->item[n].object;
        d[0] = at->x[0] + arm[0] - ball->x;
        d[1] = at->x[1] + arm[1] - ball->y;
        d[2] = at->x[2] + arm[2] - ball->z;
        distance = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        gap = distance - ball->r - near->scene->object.outer[placed].r;
        *least = fmin(*least, gap);
        if (gap >= band)
            continue;
        force = gap < 0 ? -1 : (gap - band) / band;
        cost += gap < 0 ? band / 2 - gap : (gap - band) * (gap - band) / (2 * band);
        for (k = 0; k < 3 && distance > 0; k++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;

            push[k] += force * d[k] / distance;
            push[3 + k] += force * (arm[a] * d[b] - arm[b] * d[a]) / distance; /* turning by w moves the ball by w x arm */
        }
    }
    return cost;
}
