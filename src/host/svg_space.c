/* svg_space.c: a scene in space from above, from the front and from the right; obstacles nearer than the start are outlines. */
#include <math.h>
#include <stdlib.h>

#include "picture.h"
#include "svg.h"

#define GAP 24.0       /* pixels between views */
#define LABEL 22.0     /* and above one */
#define COPIES 16      /* objects along the path at most */
#define CIRCLES 3000   /* of all of them in a view, about */

/* The axes that a view shows across and up, and the one that points at the viewer (from the far side where sign is -1). */
static const struct {
    int across, up, toward;
    double sign;
    const char *name, *axis[2];
} views[SVG_VIEWS] = {
    { 0, 1, 2, 1, "from above", { "x", "y" } },
    { 0, 2, 1, -1, "from the front", { "x", "z" } },
    { 1, 2, 0, 1, "from the right", { "y", "z" } },
};

/* ---- where the views lie ---------------------------------------------------------------------------- */

/* Obstacles, start and goal with a margin; with a path, room for a part of the object beyond it. */
static void space_box(const host_answer *answer, picture_box *box)
{
    double largest = 0;
    int k;

    picture_scene_box(answer, box);
    if (answer->result->path_count > 0)
        picture_grow(box, 0.8 * picture_radius(answer));
    for (k = 0; k < 3; k++)
        largest = fmax(largest, box->high[k] - box->low[k]);
    picture_grow(box, largest > 0 ? 0.03 * largest : 1); /* a scene may be without extent */
}

double svg_space_fit(svg_canvas canvas[SVG_VIEWS], const host_answer *answer, double x, double y, double width, double most)
{
    picture_box box;
    double across = 0, up = 0, scale;
    int i;

    space_box(answer, &box);
    for (i = 0; i < SVG_VIEWS; i++) {
        svg_box *view = &canvas[i].view;

        view->left = box.low[views[i].across];
        view->right = box.high[views[i].across];
        view->bottom = box.low[views[i].up];
        view->top = box.high[views[i].up];
        across += view->right - view->left;
        up = fmax(up, view->top - view->bottom);
    }
    scale = fmin((width - (SVG_VIEWS - 1) * GAP) / across, most / up);
    x += (width - (SVG_VIEWS - 1) * GAP - across * scale) / 2;
    for (i = 0; i < SVG_VIEWS; i++) {
        const svg_box *view = &canvas[i].view;

        canvas[i].scale = scale;
        canvas[i].x0 = x - view->left * scale;
        canvas[i].y0 = y + LABEL + view->top * scale;
        x += (view->right - view->left) * scale + GAP;
    }
    return LABEL + up * scale;
}

/* ---- balls ------------------------------------------------------------------------------------------ */

typedef struct seen_ball {
    double x, y, r, depth; /* pixels; depth grows toward the viewer, in the user's numbers */
} seen_ball;

static double depth_of(int view, const double at[3])
{
    return views[view].sign * at[views[view].toward];
}

static seen_ball see(const svg_canvas *canvas, int view, const double at[3], double r)
{
    seen_ball ball;

    ball.x = svg_x(canvas, at[views[view].across]);
    ball.y = svg_y(canvas, at[views[view].up]);
    ball.r = r * canvas->scale;
    ball.depth = depth_of(view, at);
    return ball;
}

static int nearer(const void *a, const void *b)
{
    const seen_ball *one = a, *other = b;

    return (one->depth > other->depth) - (one->depth < other->depth);
}

static void write_circle(FILE *out, const seen_ball *ball, const char *style)
{
    (void)fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"%s/>\n", ball->x, ball->y, ball->r, style);
}

/* The obstacles, the farthest first; null where there is no memory. */
static seen_ball *see_obstacles(const svg_canvas *canvas, int view, const host_balls *obstacles)
{
    seen_ball *ball = malloc(((size_t)obstacles->count + 1) * sizeof *ball);
    int32_t i;

    for (i = 0; ball != NULL && i < obstacles->count; i++)
        ball[i] = see(canvas, view, obstacles->ball[i].x, obstacles->ball[i].r);
    if (ball != NULL)
        qsort(ball, (size_t)obstacles->count, sizeof *ball, nearer);
    return ball;
}

/* Behind the cut, paler with the distance. */
static void write_behind(FILE *out, const seen_ball *ball, int32_t count, double cut)
{
    const double depth = count > 0 ? fmax(cut - ball[0].depth, 1e-300) : 1;
    char style[64];
    int32_t i;

    (void)fprintf(out, "<g stroke=\"#5b646f\" stroke-width=\"0.6\" stroke-opacity=\"0.6\">\n");
    for (i = 0; i < count && ball[i].depth <= cut; i++) {
        int pale = (int)(90 * fmin(1, (cut - ball[i].depth) / depth));

        (void)snprintf(style, sizeof style, " fill=\"#%02x%02x%02x\"", 140 + pale, 148 + pale * 9 / 10, 158 + pale * 8 / 10);
        write_circle(out, &ball[i], style);
    }
    (void)fprintf(out, "</g>\n");
}

/* Before it: outlines, the fainter the more there are. */
static void write_before(FILE *out, const seen_ball *ball, int32_t count, double cut)
{
    int32_t i, first = 0;

    while (first < count && ball[first].depth <= cut)
        first++;
    (void)fprintf(out,
                  "<g fill=\"#8c949e\" fill-opacity=\"0.05\" stroke=\"#3f4752\" stroke-width=\"0.8\" stroke-opacity=\"%.2f\">\n",
                  0.25 + 0.5 * fmin(1, 20.0 / (count - first + 1)));
    for (i = first; i < count; i++)
        write_circle(out, &ball[i], "");
    (void)fprintf(out, "</g>\n");
}

/* The object at a pose: its outline, then its inside, as one shape. */
static void write_object(FILE *out, const svg_canvas *canvas, int view, const host_answer *answer, const picture_stop *stop,
                         const char *fill, const char *line, double opacity)
{
    const host_balls *object = &answer->query->object;
    double at[3];
    int32_t i;
    int pass;

    (void)fprintf(out, "<g fill=\"%s\" stroke=\"%s\" opacity=\"%.2f\">\n", fill, line, opacity);
    for (pass = 0; pass < 2; pass++)
        for (i = 0; i < object->count; i++) {
            seen_ball ball;

            picture_place(answer, stop, &object->ball[i], at);
            ball = see(canvas, view, at, object->ball[i].r);
            write_circle(out, &ball, pass == 0 ? " stroke-width=\"2.5\"" : " stroke=\"none\"");
        }
    (void)fprintf(out, "</g>\n");
}

/* ---- the cloud and the path --------------------------------------------------------------------------- */

/* Is a point of the cloud marked that the viewer sees at (i, j)? */
static int seen_marked(const picture_cloud *cloud, int view, int32_t i, int32_t j)
{
    int32_t at[3];
    int32_t *toward = &at[views[view].toward];

    at[views[view].across] = i;
    at[views[view].up] = j;
    for (*toward = 0; *toward < cloud->count[views[view].toward]; (*toward)++)
        if (picture_marked(cloud, at[0], at[1], at[2]))
            return 1;
    return 0;
}

/* What the cloud hides, as one rectangle for each run of marked points in a row. */
static void write_cloud(FILE *out, const svg_canvas *canvas, int view, const picture_cloud *cloud, double unit)
{
    const int across = views[view].across, up = views[view].up;
    const double step = cloud->pitch * unit * canvas->scale;
    int32_t i, j, begin;

    (void)fprintf(out, "<path fill=\"#6cc25c\" fill-opacity=\"0.6\" shape-rendering=\"crispEdges\" d=\"");
    for (j = 0; j < cloud->count[up]; j++)
        for (i = 0; i < cloud->count[across]; i++) {
            for (begin = i; i < cloud->count[across] && seen_marked(cloud, view, i, j);)
                i++;
            if (i > begin)
                (void)fprintf(out, "M%.2f %.2fh%.2fv%.2fh-%.2fz\n",
                              svg_x(canvas, (cloud->origin[across] + (double)cloud->pitch * begin) * unit) - step / 2,
                              svg_y(canvas, (cloud->origin[up] + (double)cloud->pitch * j) * unit) - step / 2,
                              step * (i - begin), step, step * (i - begin));
        }
    (void)fprintf(out, "\"/>\n");
}

static void write_path(FILE *out, const svg_canvas *canvas, int view, const host_answer *answer)
{
    const double unit = answer->grid->unit;
    const int across = views[view].across, up = views[view].up;
    int32_t i;

    (void)fprintf(out, "<polyline fill=\"none\" stroke=\"#8e2466\" stroke-width=\"2\" stroke-linejoin=\"round\" "
                       "marker-end=\"url(#arrow)\" points=\"");
    for (i = 0; i < answer->result->path_count; i++) {
        const cage_pose *pose = &answer->result->path[i];

        if (i == 0 || pose->x[across] != pose[-1].x[across] || pose->x[up] != pose[-1].x[up])
            (void)fprintf(out, "%.2f,%.2f\n", svg_x(canvas, pose->x[across] * unit), svg_y(canvas, pose->x[up] * unit));
    }
    (void)fprintf(out, "\"/>\n");
}

static void write_copies(FILE *out, const svg_canvas *canvas, int view, const host_answer *answer)
{
    const int32_t balls = answer->query->object.count;
    const int most = (int)fmax(4, fmin(COPIES, (double)CIRCLES / (balls + 1)));
    picture_stop stop[COPIES];
    picture_box box;
    int i, count;

    space_box(answer, &box);
    count = picture_trail(answer, &box, stop, most);
    for (i = 0; i < count; i++)
        write_object(out, canvas, view, answer, &stop[i], "#6ea2ea", "#1f57b0", 0.16);
}

/* ---- the picture ---------------------------------------------------------------------------------------- */

/* Above a view: two arrows for its axes, and its name. */
static void write_label(FILE *out, const svg_canvas *canvas, int view)
{
    const double x = svg_x(canvas, canvas->view.left), y = svg_y(canvas, canvas->view.top) - 4;

    (void)fprintf(out, "<g transform=\"translate(%.1f %.1f)\" font-size=\"11\" fill=\"#66707c\">"
                       "<path d=\"M2 -12V0H14M0 -9l2 -3l2 3M11 -2l3 2l-3 2\" fill=\"none\" stroke=\"#66707c\"/>"
                       "<text x=\"17\" y=\"3\">%s</text><text x=\"6\" y=\"-6\">%s</text>"
                       "<text x=\"32\" y=\"0\" font-size=\"12\">%s</text></g>\n",
                  x, y, views[view].axis[0], views[view].axis[1], views[view].name);
}

static void write_view(FILE *out, const svg_canvas *canvas, int view, const host_answer *answer)
{
    static const char red[] = "#ef6a6a", dark_red[] = "#a01818";
    const cage_result *result = answer->result;
    const int hit = result->verdict == CAGE_IN_COLLISION, goal_hit = hit && result->reason == CAGE_REASON_GOAL;
    const host_balls *obstacles = &answer->query->obstacles;
    const svg_box *box = &canvas->view;
    seen_ball *ball = see_obstacles(canvas, view, obstacles);
    picture_stop start, goal;
    double cut;

    picture_stop_at(answer, &answer->grid->start, &start);
    cut = depth_of(view, start.x);
    write_label(out, canvas, view);
    (void)fprintf(out, "<clipPath id=\"view%d\"><rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"/></clipPath>\n", view,
                  svg_x(canvas, box->left), svg_y(canvas, box->top), (box->right - box->left) * canvas->scale,
                  (box->top - box->bottom) * canvas->scale);
    (void)fprintf(out, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"none\" stroke=\"#d5d9de\"/>\n"
                       "<g clip-path=\"url(#view%d)\">\n",
                  svg_x(canvas, box->left), svg_y(canvas, box->top), (box->right - box->left) * canvas->scale,
                  (box->top - box->bottom) * canvas->scale, view);
    if (ball != NULL)
        write_behind(out, ball, obstacles->count, cut);
    if (answer->cloud != NULL)
        write_cloud(out, canvas, view, answer->cloud, answer->grid->unit);
    if (result->path_count > 0)
        write_copies(out, canvas, view, answer);
    if (answer->query->has_goal) {
        picture_stop_at(answer, &answer->grid->goal, &goal);
        write_object(out, canvas, view, answer, &goal, goal_hit ? red : "#f7b267", goal_hit ? dark_red : "#c25e10", 0.8);
    }
    write_object(out, canvas, view, answer, &start, hit && !goal_hit ? red : "#6ea2ea", hit && !goal_hit ? dark_red : "#1f57b0",
                 0.8);
    if (result->path_count > 0)
        write_path(out, canvas, view, answer);
    (void)fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"2.5\" fill=\"#1c2733\"/>\n",
                  svg_x(canvas, start.x[views[view].across]), svg_y(canvas, start.x[views[view].up]));
    if (ball != NULL)
        write_before(out, ball, obstacles->count, cut);
    (void)fprintf(out, "</g>\n");
    free(ball);
}

static void write_legend(FILE *out, const host_answer *answer, double x, double y)
{
    x = svg_legend(out, x, y, "<circle cx=\"9\" r=\"7\" fill=\"#a3abb5\" stroke=\"#5b646f\"/>", "obstacles");
    x = svg_legend(out, x, y, "<circle cx=\"9\" r=\"7\" fill=\"none\" stroke=\"#5b646f\" stroke-opacity=\"0.5\"/>",
                   answer->name != NULL ? "nearer than the object" : "nearer than the start");
    x = svg_legend(out, x, y, "<circle cx=\"9\" r=\"7\" fill=\"#6ea2ea\" stroke=\"#1f57b0\"/>"
                              "<circle cx=\"9\" r=\"2.5\" fill=\"#1c2733\"/>",
                   answer->name != NULL ? "a pose of it, and the pivot" : "start and pivot");
    if (answer->query->has_goal)
        x = svg_legend(out, x, y, "<circle cx=\"9\" r=\"7\" fill=\"#f7b267\" stroke=\"#c25e10\"/>", "goal");
    if (answer->cloud != NULL)
        (void)svg_legend(out, x, y, "<rect x=\"1\" y=\"-7\" width=\"16\" height=\"14\" fill=\"#6cc25c\" fill-opacity=\"0.6\"/>",
                         answer->name != NULL ? "where the pivot is" : "the pivot never leaves this");
    else if (picture_stuck(answer->result))
        (void)svg_legend(out, x, y, "", "(no memory to draw the region)");
    if (answer->result->path_count > 0)
        (void)svg_legend(out, x, y, "<path d=\"M0 0h18\" stroke=\"#8e2466\" stroke-width=\"2\"/>", "path of the pivot");
}

void svg_space(FILE *out, const svg_canvas canvas[SVG_VIEWS], const host_answer *answer, double x, double y)
{
    int i;

    (void)fprintf(out, "<defs>\n");
    svg_arrow(out);
    (void)fprintf(out, "</defs>\n");
    for (i = 0; i < SVG_VIEWS; i++)
        write_view(out, &canvas[i], i, answer);
    write_legend(out, answer, x, y);
}
