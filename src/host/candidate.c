/* candidate.c: a way that was not closed and not certified: its steps, its path, and where the object collides on it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "smooth.h"

#define STEPS 65536       /* at most, of each */
#define POSES 262144
#define FINE 0.01         /* of the object's radius: distance between the places looked at, */
#define MOST 2000000L     /* unless they are more than these */

int host_find_candidate(const host_answer *answer, host_candidate *out, host_error *error)
{
    int32_t count[2], state;

    memset(out, 0, sizeof *out);
    out->step = malloc(STEPS * sizeof *out->step);
    out->pose = malloc(POSES * sizeof *out->pose);
    if (out->step == NULL || out->pose == NULL)
        return host_fail(error, HOST_MEMORY, "no memory for a candidate");
    state = cage_prove_candidate(answer->proof, out->step, STEPS, out->pose, POSES, count);
    if (state != 1 || count[0] > STEPS || count[1] > POSES)
        return HOST_OK; /* there is none that can be shown */
    out->steps = count[0];
    out->count = count[1];
    return HOST_OK;
}

void host_free_candidate(host_candidate *candidate)
{
    free(candidate->step);
    free(candidate->pose);
    free(candidate->place);
    memset(candidate, 0, sizeof *candidate);
}

/* The least gap at one place, of pairs that touch or overlap; 0 if there is none. -1: no memory. */
static int gap_at(const host_answer *answer, const way_station *at, double *gap)
{
    way_near *near = way_near_find(answer, at, 1, 0);
    double push[6] = { 0 };

    *gap = 0;
    if (near == NULL)
        return -1;
    (void)way_near_cost(near, 0, at, 1, push, gap);
    way_near_free(near);
    return 0;
}

static int add_place(host_candidate *c, size_t *room)
{
    host_overlap *more;

    if ((size_t)c->places < *room)
        return 0;
    *room = 2 * *room + 16;
    more = realloc(c->place, *room * sizeof *more);
    if (more == NULL)
        return -1;
    c->place = more;
    return 0;
}

int host_look_at_candidate(const host_answer *answer, host_candidate *c, host_error *error)
{
    const double radius = way_radius(answer), length = way_length(c->pose, c->count, radius);
    const double step = fmax(FINE * radius, length / (double)MOST);
    size_t room = 0;
    int32_t i;
    int inside = 0, n, pieces;

    for (i = 0; i + 1 < c->count; i++) {
        way_station a, b, at;

        way_station_of(&c->pose[i], &a);
        way_station_of(&c->pose[i + 1], &b);
        pieces = 1 + (int)(way_length(&c->pose[i], 2, radius) / step);
        for (n = 0; n < pieces; n++) {
            double gap;

            way_between(&a, &b, (double)n / pieces, &at);
            if (gap_at(answer, &at, &gap) < 0 || (gap < 0 && !inside && add_place(c, &room) < 0))
                return host_fail(error, HOST_MEMORY, "no memory for a candidate");
            if (gap < 0 && !inside)
                c->place[c->places++].depth = 0;
            inside = gap < 0;
            if (inside && -gap > c->place[c->places - 1].depth) {
                c->place[c->places - 1].depth = -gap;
                c->place[c->places - 1].leg = i;
                way_pose(&at, answer->query->dim, &c->place[c->places - 1].at);
            }
        }
    }
    return HOST_OK;
}
