/* atlas_report.c: an atlas as a table of its classes, and as one JSON object. */
#include <math.h>
#include <stdlib.h>

#include "atlas_host.h"

static int by_size(const void *a, const void *b)
{
    const host_row *x = a, *y = b;

    if (x->class.cells != y->class.cells)
        return x->class.cells > y->class.cells ? -1 : 1;
    return x->number < y->number ? -1 : 1;
}

host_row *host_rows(const cage_atlas *atlas, int32_t side)
{
    const int32_t count = atlas->classes[side == CAGE_SIDE_OUTER];
    host_row *made = malloc((size_t)count * sizeof *made);
    int32_t i;

    for (i = 0; made != NULL && i < count; i++) {
        made[i].number = i;
        (void)cage_atlas_class(atlas, side, i, &made[i].class);
    }
    if (made != NULL)
        qsort(made, (size_t)count, sizeof *made, by_size);
    return made;
}

double host_class_turn(const cage_class *class)
{
    const double sine = class->sine / 1073741824.0;

    return sine < 1 ? asin(sine) * 360 / acos(-1.0) : 180;
}

static void print_turn(FILE *out, const cage_class *class, int32_t dim)
{
    const double turn = host_class_turn(class);

    if (turn >= 180)
        (void)fprintf(out, "  any turn");
    else if (dim == 2)
        (void)fprintf(out, "  turn %.4g +- %.4g", atan2(class->q[3], class->q[0]) * 360 / acos(-1.0), turn);
    else
        (void)fprintf(out, "  turn within %.4g of %ld,%ld,%ld,%ld", turn, (long)class->q[0], (long)class->q[1], (long)class->q[2],
                      (long)class->q[3]);
}

static void print_class(FILE *out, const host_row *r, const cage_atlas *atlas, int32_t side, double unit, int32_t halvings)
{
    double bound[2];
    int k;

    (void)fprintf(out, "  %7ld  %-8s %7ld %7ld", (long)r->number, r->number == 0 ? "outside" : "bounded", (long)r->class.cells,
                  (long)r->class.nodes);
    if (r->number > 0) {
        host_volume(atlas, side, r->number, unit, halvings, bound);
        (void)fprintf(out, "  %10.4g %10.4g", bound[0], bound[1]);
        for (k = 0; k < atlas->dim; k++)
            (void)fprintf(out, "  %c %.5g to %.5g", "xyz"[k], r->class.low[k] * unit, r->class.high[k] * unit);
        print_turn(out, &r->class, atlas->dim);
    }
    (void)fprintf(out, "\n");
}

static void print_side(FILE *out, const cage_atlas *atlas, int32_t side, double unit, int32_t halvings)
{
    const int32_t count = atlas->classes[side == CAGE_SIDE_OUTER];
    host_row *rows = host_rows(atlas, side);
    int32_t i;

    (void)fprintf(out, "\n%s, %ld classes: %s\n", side == CAGE_SIDE_INNER ? "Inner" : "Outer", (long)count,
                  side == CAGE_SIDE_INNER ? "no path joins two of them" : "paths join all that is in one");
    (void)fprintf(out, "  %7s  %-8s %7s %7s  %10s %10s  where the pivot is\n", "class", "", "cells", "pieces", "volume >=", "<=");
    for (i = 0; rows != NULL && i < count && i < HOST_ROWS; i++)
        print_class(out, &rows[i], atlas, side, unit, halvings);
    if (count > HOST_ROWS)
        (void)fprintf(out, "  ... and %ld smaller ones\n", (long)(count - HOST_ROWS));
    free(rows);
}

static void print_passages(FILE *out, const host_passages *passages, const cage_atlas *atlas, double unit)
{
    int32_t i;

    (void)fprintf(out, "\nPassages: two outer classes join when every radius shrinks by (not by the first, by the second)\n");
    for (i = 0; i < passages->count; i++) {
        const host_passage *passage = &passages->list[i];
        const cage_margin *margin = &passage->margin;
        host_pose narrow;
        char to[16] = "the outside";

        if (passage->to > 0)
            (void)snprintf(to, sizeof to, "%ld", (long)passage->to);
        (void)fprintf(out, "  %5ld and %-11s  ", (long)passage->from, to);
        if (margin->bounded)
            (void)fprintf(out, "%.6g, ", margin->closed * unit);
        (void)fprintf(out, "%.6g", margin->open * unit);
        if (margin->known) {
            host_from_grid(&margin->narrow, margin->pivot, atlas->dim, unit, &narrow);
            (void)fprintf(out, "  at ");
            host_print_pose(out, &narrow);
        }
        (void)fprintf(out, "\n");
    }
}

void host_report_atlas(FILE *out, const char *path, const host_built *made, double unit, int32_t halvings,
                       const host_passages *passages)
{
    const cage_survey_result *work = &made->work;
    const double balls = (double)(work->balls[0] + work->balls[1]);

    (void)fprintf(out, "Atlas   %s: %.1f KiB", path, (double)work->atlas_bytes / 1024);
    if (balls > 0 && !made->resumed)
        (void)fprintf(out, ", %.2f bytes for each ball and slice", (double)work->atlas_bytes / balls);
    (void)fprintf(out, "\n");
    (void)fprintf(out, "Cells   %ld, the finest of level %ld\n", (long)work->leaves, (long)work->level);
    (void)fprintf(out, "Work    %ld + %ld slices, %ld + %ld gluings (%ld + %ld by a triangulation of their own), %.1f MiB, %.3f s\n",
                  (long)work->slices[0], (long)work->slices[1], (long)work->gluings[0], (long)work->gluings[1],
                  (long)work->mixtures[0], (long)work->mixtures[1], (double)work->peak_bytes / (double)HOST_MIB, made->seconds);
    if (made->resumed)
        (void)fprintf(out, "        since it was interrupted, or its memory grew\n");
    (void)fprintf(out, "Unit    %.6g\n", unit);
    if (made->atlas.side & CAGE_SIDE_INNER)
        print_side(out, &made->atlas, CAGE_SIDE_INNER, unit, halvings);
    if (made->atlas.side & CAGE_SIDE_OUTER)
        print_side(out, &made->atlas, CAGE_SIDE_OUTER, unit, halvings);
    if (passages != NULL)
        print_passages(out, passages, &made->atlas, unit);
}

static void json_numbers(FILE *out, const char *name, const double *number, int count)
{
    int k;

    (void)fprintf(out, ", \"%s\": [", name);
    for (k = 0; k < count; k++)
        (void)fprintf(out, "%s%.17g", k > 0 ? ", " : "", number[k] + 0.0);
    (void)fprintf(out, "]");
}

/* "turn" is how far rotations may be from "middle". */
static void json_class(FILE *out, const cage_atlas *atlas, const host_row *r, double unit, const double *volume)
{
    const cage_class *class = &r->class;
    const double q[4] = { class->q[0], class->q[1], class->q[2], class->q[3] };
    const double middle = atan2(q[3], q[0]) * 360 / acos(-1.0);
    double low[3], high[3];
    int k;

    (void)fprintf(out, "{\"class\": %ld, \"bounded\": %s, \"cells\": %ld, \"components\": %ld", (long)r->number,
                  r->number > 0 ? "true" : "false", (long)class->cells, (long)class->nodes);
    if (r->number > 0) {
        for (k = 0; k < 3; k++) {
            low[k] = class->low[k] * unit;
            high[k] = class->high[k] * unit;
        }
        json_numbers(out, "low", low, atlas->dim);
        json_numbers(out, "high", high, atlas->dim);
        json_numbers(out, "middle", atlas->dim == 2 ? &middle : q, atlas->dim == 2 ? 1 : 4);
        (void)fprintf(out, ", \"turn\": %.17g", host_class_turn(class));
        if (volume != NULL)
            json_numbers(out, "volume", volume, 2);
    }
    (void)fprintf(out, "}");
}

/* In the order of their numbers; volumes of the largest. */
static void json_side(FILE *out, const char *name, const cage_atlas *atlas, int32_t side, double unit, int32_t halvings)
{
    const int32_t count = atlas->side & side ? atlas->classes[side == CAGE_SIDE_OUTER] : 0;
    host_row *rows = count > 0 ? host_rows(atlas, side) : NULL, *large = NULL;
    int32_t i, k;

    (void)fprintf(out, ",\n  \"%s\": [", name);
    for (i = 0; rows != NULL && i < count; i++) {
        host_row row;
        double volume[2];

        row.number = i;
        (void)cage_atlas_class(atlas, side, i, &row.class);
        for (large = NULL, k = 0; k < count && k < HOST_ROWS && i > 0; k++)
            large = rows[k].number == i ? &rows[k] : large;
        if (large != NULL)
            host_volume(atlas, side, i, unit, halvings, volume);
        (void)fprintf(out, "%s\n    ", i > 0 ? "," : "");
        json_class(out, atlas, &row, unit, large != NULL ? volume : NULL);
    }
    (void)fprintf(out, "%s]", count > 0 ? "\n  " : "");
    free(rows);
}

static void json_passages(FILE *out, const host_passages *passages, const cage_atlas *atlas, double unit)
{
    int32_t i;

    (void)fprintf(out, ",\n  \"passages\": [");
    for (i = 0; i < passages->count; i++) {
        const host_passage *passage = &passages->list[i];
        const cage_margin *margin = &passage->margin;
        host_pose narrow;

        (void)fprintf(out, "%s\n    {\"from\": %ld, \"to\": %ld, \"closed\": ", i > 0 ? "," : "", (long)passage->from,
                      (long)passage->to);
        (void)fprintf(out, margin->bounded ? "%.17g" : "null", margin->closed * unit);
        (void)fprintf(out, ", \"open\": %.17g, \"narrow\": ", margin->open * unit);
        if (margin->known)
            host_from_grid(&margin->narrow, margin->pivot, atlas->dim, unit, &narrow);
        (void)fprintf(out, margin->known ? "[" : "null}");
        if (margin->known) {
            host_print_pose(out, &narrow);
            (void)fprintf(out, "]}");
        }
    }
    (void)fprintf(out, "%s]", passages->count > 0 ? "\n  " : "");
}

void host_report_atlas_json(FILE *out, const host_built *made, double unit, int32_t halvings, const host_passages *passages)
{
    const cage_survey_result *work = &made->work;

    (void)fprintf(out, "{\n  \"dim\": %ld,\n  \"unit\": %.17g,\n  \"bytes\": %llu,\n  \"level\": %ld,\n  \"cells\": %ld,\n",
                  (long)made->atlas.dim, unit, (unsigned long long)work->atlas_bytes, (long)work->level, (long)work->leaves);
    (void)fprintf(out, "  \"slices\": [%ld, %ld],\n  \"gluings\": [%ld, %ld],\n  \"balls\": [%lld, %lld],\n", (long)work->slices[0],
                  (long)work->slices[1], (long)work->gluings[0], (long)work->gluings[1], (long long)work->balls[0],
                  (long long)work->balls[1]);
    (void)fprintf(out, "  \"peak_bytes\": %llu,\n  \"seconds\": %.6f,\n  \"side\": %ld", (unsigned long long)work->peak_bytes,
                  made->seconds, (long)made->atlas.side);
    json_side(out, "inner", &made->atlas, CAGE_SIDE_INNER, unit, halvings);
    json_side(out, "outer", &made->atlas, CAGE_SIDE_OUTER, unit, halvings);
    if (passages != NULL)
        json_passages(out, passages, &made->atlas, unit);
    (void)fprintf(out, "\n}\n");
}
