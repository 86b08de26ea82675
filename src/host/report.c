/* report.c: an answer as sentences, and as one JSON object. */
#include <math.h>

#include "parts.h"

/* ---- text ---------------------------------------------------------------------------------------- */

static const char *verdict_sentence(const cage_result *result)
{
    switch (result->verdict) {
    case CAGE_CAGED: return "Proved: no path leads from the start to arbitrarily far away.";
    case CAGE_DISCONNECTED: return "Proved: no path joins start and goal.";
    case CAGE_FREE: return "Proved by a path: the object can leave.";
    case CAGE_CONNECTED: return "Proved by a path: the object gets from start to goal.";
    case CAGE_IN_COLLISION:
        return result->reason == CAGE_REASON_GOAL ? "The goal itself collides." : "The start itself collides.";
    default: return "Not decided.";
    }
}

/* What to try when the answer is UNDEFINED. */
static const char *advice(const cage_result *result, const cage_limits *limits)
{
    const int one_sided = limits->side != CAGE_SIDE_BOTH;

    if (result->verdict == CAGE_UNDEFINED && one_sided)
        return " The other --side, or both, may decide it.";
    switch (result->reason) {
    case CAGE_REASON_LEVEL: return " A larger --max-level may decide it.";
    case CAGE_REASON_CELLS: return " A larger --max-cells may decide it.";
    default: return "";
    }
}

void host_print_pose(FILE *out, const host_pose *pose)
{
    if (pose->dim == 2)
        (void)fprintf(out, "%.10g,%.10g,%.8g", pose->x[0], pose->x[1], pose->degrees);
    else
        (void)fprintf(out, "%.10g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g", pose->x[0], pose->x[1], pose->x[2],
                      pose->q[0], pose->q[1], pose->q[2], pose->q[3]);
}

/* The pose on the grid, and by how much it differs from the one asked for. */
static void print_query_pose(FILE *out, const char *name, const cage_pose *pose, const host_pose *asked,
                             const host_grid *grid)
{
    host_pose used;
    double x, y, z;

    host_from_grid(pose, NULL, asked->dim, grid->unit, &used);
    x = used.x[0] - asked->x[0];
    y = used.x[1] - asked->x[1];
    z = used.x[2] - asked->x[2];
    (void)fprintf(out, "%s ", name);
    host_print_pose(out, &used);
    if (x == 0 && y == 0 && z == 0)
        (void)fprintf(out, "\n");
    else
        (void)fprintf(out, " (on the grid, %.2g from where asked)\n", hypot(hypot(x, y), z));
}

static void print_unit(FILE *out, const host_grid *grid)
{
    int exponent;
    double fraction = frexp(grid->unit, &exponent);

    (void)fprintf(out, "Unit    %.6g", grid->unit);
    if (fraction == 0.5)
        (void)fprintf(out, " = 2^%d", exponent - 1);
    if (grid->rounded == 0)
        (void)fprintf(out, "; the grid holds every ball exactly.\n");
    else
        (void)fprintf(out, "; %ld balls rounded, each by less than 3 units and to the safe side.\n",
                      (long)grid->rounded);
    if (grid->dropped > 0)
        (void)fprintf(out, "        %ld balls are too small for this grid: proofs of CAGED and DISCONNECTED go without.\n",
                      (long)grid->dropped);
}

static void print_side(FILE *out, const cage_result *result, int side)
{
    (void)fprintf(out, "%s  %ld slices, %ld gluings (%ld by a triangulation of their own), %ld components reached\n",
                  side == 0 ? "Inner " : "Outer ", (long)result->slices[side], (long)result->gluings[side],
                  (long)result->mixtures[side], (long)result->reached[side]);
}

/* The turn, in degrees, from the middle of a cell in space to the farthest rotation of any cell of that level. */
static double largest_turn(int level)
{
    static const double coarse[] = { 120, 71.6, 39.3, 20 };

    return level < 3 ? coarse[level] : ldexp(coarse[3], 3 - level);
}

static void print_work(FILE *out, const host_answer *answer)
{
    const cage_result *result = answer->result;
    long long balls = (long long)(result->balls[0] + result->balls[1]);
    long long inserted = (long long)(result->inserted[0] + result->inserted[1]);
    int side;

    (void)fprintf(out, "Search  %ld cells of rotations, the finest of level %ld", (long)result->cells,
                  (long)result->level);
    if (answer->query->dim == 2)
        (void)fprintf(out, " (about %.2g degrees wide)", ldexp(180, -(int)result->level));
    else
        (void)fprintf(out, " (within %.3g degrees of its middle)", largest_turn((int)result->level));
    (void)fprintf(out, "\n");
    for (side = 0; side < 2; side++)
        if (result->slices[side] > 0)
            print_side(out, result, side);
    (void)fprintf(out, "Work    %lld steps, %lld of %lld balls triangulated, %.1f MiB, %.3f s\n",
                  (long long)result->steps, inserted, balls, (double)result->peak_bytes / 1048576,
                  answer->seconds);
}

static void print_pivot(FILE *out, const host_answer *answer)
{
    const int32_t *pivot = answer->result->pivot;
    double unit = answer->grid->unit;

    (void)fprintf(out, "%.10g,%.10g", pivot[0] * unit, pivot[1] * unit);
    if (answer->query->dim == 3)
        (void)fprintf(out, ",%.10g", pivot[2] * unit);
}

static void print_margin(FILE *out, const host_answer *answer)
{
    const cage_margin *margin = answer->margin;
    host_pose narrow;

    if (margin->bounded)
        (void)fprintf(out, "Margin  %.6g to %.6g: closed with every radius less by the first, open by the second; %ld proofs\n",
                      margin->closed * answer->grid->unit, margin->open * answer->grid->unit, (long)margin->proofs);
    else
        (void)fprintf(out, "Margin  below %.6g: open with every radius less by that, and grown as far as the grid allows\n",
                      margin->open * answer->grid->unit);
    if (margin->known) {
        host_from_grid(&margin->narrow, margin->pivot, answer->query->dim, answer->grid->unit, &narrow);
        (void)fprintf(out, "        narrowest at ");
        host_print_pose(out, &narrow);
        (void)fprintf(out, "\n");
    }
}

static void print_way(FILE *out, const host_answer *answer)
{
    const host_way *way = answer->way;
    const double unit = answer->grid->unit;

    if (way->smooth)
        (void)fprintf(out, "        smoothed: length %.6g instead of %.6g, and proved with the curve through the poses,\n"
                           "        which is off the straight legs between them by %.2g at most\n",
                      way->length * unit, way->found_length * unit, way->deviation * unit);
    else
        (void)fprintf(out, "        not smoothed: no shorter path was certified; length %.6g\n", way->length * unit);
}

static void print_candidate(FILE *out, const host_answer *answer)
{
    const host_candidate *c = answer->candidate;
    host_pose at;
    int32_t i;

    (void)fprintf(out, "Candidate  not proved: a way of %ld cells and %ld poses that balls made smaller can go; on it the\n"
                       "        object %s\n",
                  (long)c->steps, (long)c->count, c->places == 0 ? "was not seen to collide" : "collides:");
    for (i = 0; i < c->places; i++) {
        host_from_grid(&c->place[i].at, answer->result->pivot, answer->query->dim, answer->grid->unit, &at);
        (void)fprintf(out, "        by %.3g at ", c->place[i].depth * answer->grid->unit);
        host_print_pose(out, &at);
        (void)fprintf(out, ", after pose %ld\n", (long)c->place[i].leg + 1);
    }
}

static void print_cover(FILE *out, const char *whose, const parts_cover *cover)
{
    (void)fprintf(out, "        %s: %ld of %ld balls lie inside its parts", whose, (long)(cover->balls - cover->out),
                  (long)cover->balls);
    if (cover->out > 0)
        (void)fprintf(out, " (ball %ld does not)", (long)cover->first + 1);
    (void)fprintf(out, "; of %ld points of its parts %ld are in no ball\n", cover->points, cover->bare);
}

static void print_parts(FILE *out, const host_answer *answer)
{
    const parts_check *check = answer->parts;
    host_pose at;
    int32_t i;

    (void)fprintf(out, "Parts   a check with the true shapes, by samples (%s): no proof\n", host_parts_name());
    if (check->kind != 0 && check->places == 0)
        (void)fprintf(out, "        %s: %ld poses looked at, apart by %.3g or more at each%s\n",
                      check->kind == 1 ? "path" : "candidate", check->poses, check->least,
                      check->whole ? ", and nothing skipped between" : "; NOT to its end: nothing is said of the rest");
    else if (check->kind != 0)
        (void)fprintf(out, "        %s: %ld poses looked at%s:\n", check->kind == 1 ? "path" : "candidate", check->poses,
                      check->whole ? "" : ", NOT to its end");
    for (i = 0; i < check->places; i++) {
        host_from_grid(&check->place[i].at, answer->result->pivot, answer->query->dim, answer->grid->unit, &at);
        if (check->place[i].overlaps)
            (void)fprintf(out, "        overlap by %.3g at ", check->place[i].depth);
        else
            (void)fprintf(out, "        closer than %.3g at ", check->finest);
        host_print_pose(out, &at);
        (void)fprintf(out, ", after pose %ld\n", (long)check->place[i].leg + 1);
    }
    print_cover(out, "object", &check->cover[0]);
    print_cover(out, "obstacles", &check->cover[1]);
}

void host_report_text(FILE *out, const host_answer *answer)
{
    const cage_result *result = answer->result;
    const host_query *query = answer->query;

    (void)fprintf(out, "%s\n\n%s\n", cage_verdict_text(result->verdict), verdict_sentence(result));
    (void)fprintf(out, "Reason  %s.%s\n", cage_reason_text(result->reason), advice(result, answer->limits));
    print_query_pose(out, "Start  ", &answer->grid->start, &query->start, answer->grid);
    if (query->has_goal)
        print_query_pose(out, "Goal   ", &answer->grid->goal, &query->goal, answer->grid);
    if (result->path_count > 0) {
        (void)fprintf(out, "Path    %ld poses, turning about the object's point ", (long)result->path_count);
        print_pivot(out, answer);
        (void)fprintf(out, "; checked again, apart from the search\n");
    }
    if (answer->way != NULL)
        print_way(out, answer);
    if (answer->candidate != NULL)
        print_candidate(out, answer);
    if (answer->parts != NULL)
        print_parts(out, answer);
    if (answer->margin != NULL)
        print_margin(out, answer);
    print_unit(out, answer->grid);
    if (result->verdict != CAGE_IN_COLLISION)
        print_work(out, answer);
}

/* ---- JSON ---------------------------------------------------------------------------------------- */

static void json_string(FILE *out, const char *name, const char *text)
{
    (void)fprintf(out, "  \"%s\": \"", name);
    for (; *text != '\0'; text++)
        if (*text == '"' || *text == '\\')
            (void)fprintf(out, "\\%c", *text);
        else if ((unsigned char)*text < 0x20)
            (void)fprintf(out, "\\u%04x", (unsigned)(unsigned char)*text);
        else
            (void)putc(*text, out);
    (void)fprintf(out, "\",\n");
}

static void json_numbers(FILE *out, const double *number, int count)
{
    int i;

    (void)fprintf(out, "[");
    for (i = 0; i < count; i++)
        (void)fprintf(out, "%s%.17g", i > 0 ? ", " : "", number[i] + 0.0); /* no -0 */
    (void)fprintf(out, "]");
}

static void json_pose(FILE *out, const host_pose *pose)
{
    double value[7];
    int k;

    for (k = 0; k < 3; k++)
        value[k] = pose->x[k];
    for (k = 0; k < 4; k++)
        value[3 + k] = pose->q[k];
    if (pose->dim == 2)
        value[2] = pose->degrees;
    json_numbers(out, value, pose->dim == 2 ? 3 : 7);
}

static void json_grid_pose(FILE *out, const char *name, const cage_pose *pose, const host_answer *answer)
{
    host_pose used;

    host_from_grid(pose, NULL, answer->query->dim, answer->grid->unit, &used);
    (void)fprintf(out, "  \"%s\": ", name);
    json_pose(out, &used);
    (void)fprintf(out, ",\n");
}

/* Counts of the two sides: [inner, outer]. */
static void json_sides(FILE *out, const char *name, int64_t inner, int64_t outer)
{
    (void)fprintf(out, "  \"%s\": [%lld, %lld],\n", name, (long long)inner, (long long)outer);
}

static void json_margin(FILE *out, const host_answer *answer)
{
    const cage_margin *margin = answer->margin;
    host_pose narrow;

    (void)fprintf(out, "  \"margin\": [");
    if (margin->bounded)
        (void)fprintf(out, "%.17g", margin->closed * answer->grid->unit + 0.0);
    else
        (void)fprintf(out, "null");
    (void)fprintf(out, ", %.17g],\n  \"narrow\": ", margin->open * answer->grid->unit + 0.0);
    if (margin->known) {
        host_from_grid(&margin->narrow, margin->pivot, answer->query->dim, answer->grid->unit, &narrow);
        json_pose(out, &narrow);
    } else {
        (void)fprintf(out, "null");
    }
    (void)fprintf(out, ",\n");
}

/* Poses of the pivot as a list. */
static void json_poses(FILE *out, const cage_pose *list, int32_t count, const host_answer *answer)
{
    const cage_result *result = answer->result;
    int32_t i;

    (void)fprintf(out, "[");
    for (i = 0; i < count; i++) {
        host_pose pose;

        host_from_grid(&list[i], result->pivot, answer->query->dim, answer->grid->unit, &pose);
        (void)fprintf(out, "%s\n    ", i > 0 ? "," : "");
        json_pose(out, &pose);
    }
    (void)fprintf(out, "%s]", count > 0 ? "\n  " : "");
}

/* Steps: [quaternion of the cell's middle, level, component, first pose]; collisions: [pose, depth]. */
static void json_candidate(FILE *out, const host_answer *answer)
{
    const host_candidate *c = answer->candidate;
    int32_t i;

    (void)fprintf(out, "  \"candidate\": {\n  \"steps\": [");
    for (i = 0; i < c->steps; i++)
        (void)fprintf(out, "%s\n    [[%ld, %ld, %ld, %ld], %ld, %ld, %ld]", i > 0 ? "," : "", (long)c->step[i].q[0],
                      (long)c->step[i].q[1], (long)c->step[i].q[2], (long)c->step[i].q[3], (long)c->step[i].level,
                      (long)c->step[i].component, (long)c->step[i].pose);
    (void)fprintf(out, "],\n  \"collisions\": [");
    for (i = 0; i < c->places; i++) {
        host_pose at;

        host_from_grid(&c->place[i].at, answer->result->pivot, answer->query->dim, answer->grid->unit, &at);
        (void)fprintf(out, "%s\n    [", i > 0 ? "," : "");
        json_pose(out, &at);
        (void)fprintf(out, ", %.17g]", c->place[i].depth * answer->grid->unit);
    }
    (void)fprintf(out, "],\n  \"path\": ");
    json_poses(out, c->pose, c->count, answer);
    (void)fprintf(out, "},\n");
}

/* Places: [pose, depth], the depth null where they are too close to tell. Object and obstacles: [balls, of these outside, points,
 * of these in no ball]. */
static void json_parts(FILE *out, const host_answer *answer)
{
    static const char *const kinds[] = { "null", "\"path\"", "\"candidate\"" };
    const parts_check *check = answer->parts;
    int32_t i;
    int side;

    (void)fprintf(out, "  \"parts\": {\n  \"proof\": false,\n  \"by\": \"%s\",\n  \"of\": %s,\n", host_parts_name(),
                  kinds[check->kind]);
    (void)fprintf(out, "  \"clear\": %s,\n", check->kind == 0 ? "null" : check->whole && check->places == 0 ? "true" : "false");
    (void)fprintf(out, "  \"poses\": %ld,\n  \"least\": %.17g,\n  \"places\": [", check->poses, check->least);
    for (i = 0; i < check->places; i++) {
        host_pose at;

        host_from_grid(&check->place[i].at, answer->result->pivot, answer->query->dim, answer->grid->unit, &at);
        (void)fprintf(out, "%s\n    [", i > 0 ? "," : "");
        json_pose(out, &at);
        if (check->place[i].overlaps)
            (void)fprintf(out, ", %.17g]", check->place[i].depth);
        else
            (void)fprintf(out, ", null]");
    }
    (void)fprintf(out, "],\n");
    for (side = 0; side < 2; side++)
        (void)fprintf(out, "  \"%s\": [%ld, %ld, %ld, %ld]%s\n", side == 0 ? "object" : "obstacles",
                      (long)check->cover[side].balls, (long)check->cover[side].out, check->cover[side].points, check->cover[side].bare, side == 0 ? "," : "},");
}

void host_report_json(FILE *out, const host_answer *answer)
{
    const cage_result *result = answer->result;
    double pivot[3];
    int k;

    for (k = 0; k < 3; k++)
        pivot[k] = result->pivot[k] * answer->grid->unit;
    (void)fprintf(out, "{\n");
    json_string(out, "verdict", cage_verdict_text(result->verdict));
    json_string(out, "reason", cage_reason_text(result->reason));
    (void)fprintf(out, "  \"dim\": %d,\n  \"unit\": %.17g,\n", (int)answer->query->dim, answer->grid->unit);
    json_grid_pose(out, "start", &answer->grid->start, answer);
    if (answer->query->has_goal)
        json_grid_pose(out, "goal", &answer->grid->goal, answer);
    else
        (void)fprintf(out, "  \"goal\": null,\n");
    (void)fprintf(out, "  \"level\": %ld,\n  \"cells\": %ld,\n", (long)result->level, (long)result->cells);
    json_sides(out, "slices", result->slices[0], result->slices[1]);
    json_sides(out, "gluings", result->gluings[0], result->gluings[1]);
    (void)fprintf(out, "  \"steps\": %lld,\n", (long long)result->steps);
    json_sides(out, "balls_inserted", result->inserted[0], result->inserted[1]);
    (void)fprintf(out, "  \"peak_bytes\": %llu,\n  \"seconds\": %.6f,\n",
                  (unsigned long long)result->peak_bytes, answer->seconds);
    (void)fprintf(out, "  \"pivot\": ");
    json_numbers(out, pivot, answer->query->dim);
    (void)fprintf(out, ",\n");
    if (answer->margin != NULL)
        json_margin(out, answer);
    if (answer->way != NULL)
        (void)fprintf(out, "  \"smooth\": %s,\n  \"length\": %.17g,\n  \"found_length\": %.17g,\n",
                      answer->way->smooth ? "true" : "false", answer->way->length * answer->grid->unit,
                      answer->way->found_length * answer->grid->unit);
    if (answer->candidate != NULL)
        json_candidate(out, answer);
    if (answer->parts != NULL)
        json_parts(out, answer);
    (void)fprintf(out, "  \"path\": ");
    json_poses(out, result->path, result->path_count, answer);
    (void)fprintf(out, "\n}\n");
}
