/* atlas_report.c: an atlas as a table of its classes, and as one JSON object. */
#include <stdlib.h>

#include "atlas_host.h"

#define ROWS 24 /* of the table, for each side */

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

static void print_class(FILE *out, const host_row *r, int32_t dim, double unit)
{
    int k;

    (void)fprintf(out, "  %7ld  %-8s %7ld %7ld", (long)r->number, r->number == 0 ? "outside" : "bounded", (long)r->class.cells,
                  (long)r->class.nodes);
    for (k = 0; k < dim && r->number > 0; k++)
        (void)fprintf(out, "  %c %.5g to %.5g", "xyz"[k], r->class.low[k] * unit, r->class.high[k] * unit);
    (void)fprintf(out, "\n");
}

static void print_side(FILE *out, const cage_atlas *atlas, int32_t side, double unit)
{
    const int32_t count = atlas->classes[side == CAGE_SIDE_OUTER];
    host_row *rows = host_rows(atlas, side);
    int32_t i;

    (void)fprintf(out, "\n%s, %ld classes: %s\n", side == CAGE_SIDE_INNER ? "Inner" : "Outer", (long)count,
                  side == CAGE_SIDE_INNER ? "no path joins two of them" : "paths join all that is in one");
    (void)fprintf(out, "  %7s  %-8s %7s %7s  where the pivot is\n", "class", "", "cells", "pieces");
    for (i = 0; rows != NULL && i < count && i < ROWS; i++)
        print_class(out, &rows[i], atlas->dim, unit);
    if (count > ROWS)
        (void)fprintf(out, "  ... and %ld smaller ones\n", (long)(count - ROWS));
    free(rows);
}

void host_report_atlas(FILE *out, const char *path, const host_built *made, double unit)
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
        print_side(out, &made->atlas, CAGE_SIDE_INNER, unit);
    if (made->atlas.side & CAGE_SIDE_OUTER)
        print_side(out, &made->atlas, CAGE_SIDE_OUTER, unit);
}

static void json_side(FILE *out, const char *name, const cage_atlas *atlas, int32_t side, double unit)
{
    const int32_t count = atlas->side & side ? atlas->classes[side == CAGE_SIDE_OUTER] : 0;
    int32_t i;
    int k;

    (void)fprintf(out, ",\n  \"%s\": [", name);
    for (i = 0; i < count; i++) {
        cage_class class;

        (void)cage_atlas_class(atlas, side, i, &class);
        (void)fprintf(out, "%s\n    {\"class\": %ld, \"bounded\": %s, \"cells\": %ld, \"components\": %ld", i > 0 ? "," : "", (long)i,
                      i > 0 ? "true" : "false", (long)class.cells, (long)class.nodes);
        for (k = 0; k < 2 * atlas->dim && i > 0; k++)
            (void)fprintf(out, "%s%.17g%s", k == 0 ? ", \"low\": [" : k == atlas->dim ? "], \"high\": [" : ", ",
                          (k < atlas->dim ? class.low[k] : class.high[k - atlas->dim]) * unit + 0.0,
                          k == 2 * atlas->dim - 1 ? "]" : "");
        (void)fprintf(out, "}");
    }
    (void)fprintf(out, "%s]", count > 0 ? "\n  " : "");
}

void host_report_atlas_json(FILE *out, const host_built *made, double unit)
{
    const cage_survey_result *work = &made->work;

    (void)fprintf(out, "{\n  \"dim\": %ld,\n  \"unit\": %.17g,\n  \"bytes\": %llu,\n  \"level\": %ld,\n  \"cells\": %ld,\n",
                  (long)made->atlas.dim, unit, (unsigned long long)work->atlas_bytes, (long)work->level, (long)work->leaves);
    (void)fprintf(out, "  \"slices\": [%ld, %ld],\n  \"gluings\": [%ld, %ld],\n  \"balls\": [%lld, %lld],\n", (long)work->slices[0],
                  (long)work->slices[1], (long)work->gluings[0], (long)work->gluings[1], (long long)work->balls[0],
                  (long long)work->balls[1]);
    (void)fprintf(out, "  \"peak_bytes\": %llu,\n  \"seconds\": %.6f,\n  \"side\": %ld", (unsigned long long)work->peak_bytes,
                  made->seconds, (long)made->atlas.side);
    json_side(out, "inner", &made->atlas, CAGE_SIDE_INNER, unit);
    json_side(out, "outer", &made->atlas, CAGE_SIDE_OUTER, unit);
    (void)fprintf(out, "\n}\n");
}
