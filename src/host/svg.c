/* svg.c: the picture of an answer: frame, title, legend and scale around a scene in the plane or three views of space. */
#include <errno.h>
#include <math.h>
#include <string.h>

#include "svg.h"

#define WIDTH 880.0   /* of the picture, in pixels */
#define LARGEST 760.0 /* height of the scene at most */
#define SMALLEST 240.0
#define MARGIN 20.0
#define TITLE 64.0  /* height above the scene */
#define LEGEND 48.0 /* and below */

/* ---- what is shown ------------------------------------------------------------------------------- */

void svg_box_add(svg_box *box, double x, double y, double r)
{
    if (box->empty) {
        box->left = box->right = x;
        box->bottom = box->top = y;
        box->empty = 0;
    }
    box->left = fmin(box->left, x - r);
    box->right = fmax(box->right, x + r);
    box->bottom = fmin(box->bottom, y - r);
    box->top = fmax(box->top, y + r);
}

void svg_place(const host_ball *ball, const cage_pose *pose, double unit, double at[3])
{
    int32_t centre[3];
    int k;

    for (k = 0; k < 3; k++)
        centre[k] = (int32_t)floor(ball->x[k] / unit + 0.5);
    host_place(pose, centre, unit, at);
}

/* Fits a box into the area given, in pixels; returns the scene's height there. */
double svg_fit(svg_canvas *canvas, const svg_box *box, double x, double y, double width, double height)
{
    double across = box->right - box->left, up = box->top - box->bottom;
    double scale = fmin(width / across, height / up);

    canvas->scale = scale;
    canvas->view = *box;
    canvas->x0 = x + (width - across * scale) / 2 - box->left * scale;
    canvas->y0 = y + box->top * scale;
    return up * scale;
}

double svg_x(const svg_canvas *canvas, double x)
{
    return canvas->x0 + x * canvas->scale;
}

double svg_y(const svg_canvas *canvas, double y)
{
    return canvas->y0 - y * canvas->scale;
}

/* ---- the frame ------------------------------------------------------------------------------------ */

static const char *title(const cage_result *result)
{
    switch (result->verdict) {
    case CAGE_CAGED: return "the object cannot leave";
    case CAGE_DISCONNECTED: return "no path joins start and goal";
    case CAGE_FREE: return "the object can leave, by this path";
    case CAGE_CONNECTED: return "this path joins start and goal";
    case CAGE_IN_COLLISION:
        return result->reason == CAGE_REASON_GOAL ? "the goal overlaps an obstacle" : "the start overlaps an obstacle";
    default: return "a limit was reached first";
    }
}

static void write_head(FILE *out, const host_answer *answer, double height)
{
    const cage_result *result = answer->result;
    const host_pose *start = &answer->query->start;
    const char *name = answer->name != NULL ? answer->name : cage_verdict_text(result->verdict);
    const char *meaning = answer->name != NULL ? answer->title : title(result);

    (void)fprintf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
                       "width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\">\n",
                  WIDTH, height, WIDTH, height);
    (void)fprintf(out, "<title>%s: %s</title>\n", name, meaning);
    (void)fprintf(out, "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n");
    (void)fprintf(out, "<text x=\"%.0f\" y=\"30\" font-size=\"20\" fill=\"#1c2733\">"
                       "<tspan font-weight=\"bold\">%s</tspan>: %s</text>\n",
                  MARGIN, name, meaning);
    (void)fprintf(out, "<text x=\"%.0f\" y=\"50\" font-size=\"12\" fill=\"#66707c\">", MARGIN);
    (void)fprintf(out, "%ld object balls, %ld obstacle balls; %s %.6g,%.6g", (long)answer->query->object.count,
                  (long)answer->query->obstacles.count, answer->name != NULL ? "the object at" : "start",
                  start->x[0], start->x[1]);
    if (start->dim == 2)
        (void)fprintf(out, ",%.6g", start->degrees);
    else
        (void)fprintf(out, ",%.6g,%.6g,%.6g,%.6g,%.6g", start->x[2], start->q[0], start->q[1], start->q[2], start->q[3]);
    if (answer->name == NULL)
        (void)fprintf(out, "; %ld slices, %.3f s", (long)(result->slices[0] + result->slices[1]), answer->seconds);
    (void)fprintf(out, "</text>\n");
}

/* A sample with its name; returns where the next one goes. A width of about 6.3 pixels a letter. */
double svg_legend(FILE *out, double x, double y, const char *shape, const char *name)
{
    (void)fprintf(out, "<g transform=\"translate(%.1f %.1f)\">%s<text x=\"24\" y=\"4\" font-size=\"12\" "
                       "fill=\"#1c2733\">%s</text></g>\n", x, y, shape, name);
    return x + 42 + 6.3 * (double)strlen(name);
}

/* The marker at the end of a path. */
void svg_arrow(FILE *out)
{
    (void)fprintf(
        out, "<marker id=\"arrow\" viewBox=\"0 0 10 10\" refX=\"8\" refY=\"5\" "
             "markerWidth=\"5\" markerHeight=\"5\" orient=\"auto\"><path d=\"M0 0L10 5L0 10z\" fill=\"#8e2466\"/></marker>\n");
}

/* A bar of 1, 2 or 5 times a power of ten units of the user, at most 160 pixels long, its right end at x. */
static void write_scale(FILE *out, const svg_canvas *canvas, double x, double y)
{
    double longest = 160 / canvas->scale;
    double length = pow(10, floor(log10(longest)));
    double pixels;

    length *= longest >= 5 * length ? 5 : longest >= 2 * length ? 2 : 1;
    pixels = length * canvas->scale;
    (void)fprintf(out, "<path d=\"M%.1f %.1fv5h%.1fv-5\" fill=\"none\" stroke=\"#1c2733\" stroke-width=\"1.5\"/>\n",
                  x - pixels, y - 3, pixels);
    (void)fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"12\" text-anchor=\"middle\" fill=\"#1c2733\">%g</text>\n",
                  x - pixels / 2, y - 4, length);
}

static void write_svg(FILE *out, const host_answer *answer)
{
    const int space = answer->query->dim == 3;
    svg_canvas canvas[SVG_VIEWS];
    svg_box box;
    double height, y;

    if (space) {
        height = svg_space_fit(canvas, answer, MARGIN, TITLE, WIDTH - 2 * MARGIN, LARGEST);
    } else {
        svg_plane_box(answer, &box);
        height = fmax(SMALLEST, svg_fit(&canvas[0], &box, MARGIN, TITLE, WIDTH - 2 * MARGIN, LARGEST));
    }
    y = TITLE + height + LEGEND / 2;
    write_head(out, answer, TITLE + height + LEGEND);
    (space ? svg_space : svg_plane)(out, canvas, answer, MARGIN + 6, y);
    write_scale(out, &canvas[0], WIDTH - MARGIN, y);
    (void)fprintf(out, "</svg>\n");
}

int host_write_svg(const char *path, const host_answer *answer, host_error *error)
{
    FILE *out = fopen(path, "w");
    int broken;

    if (out == NULL)
        return host_fail(error, HOST_BAD_INPUT, "--svg: %.600s cannot be written: %.200s", path, strerror(errno));
    write_svg(out, answer);
    broken = ferror(out);
    broken = fclose(out) != 0 || broken;
    return broken ? host_fail(error, HOST_BAD_INPUT, "--svg: %.600s could not be written whole", path) : HOST_OK;
}
