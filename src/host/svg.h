/* svg.h: what the files that draw share: boxes in the user's numbers, and where they lie in the picture. */
#ifndef CAGE_HOST_SVG_H
#define CAGE_HOST_SVG_H

#include "host.h"

typedef struct svg_box {
    double left, right, bottom, top;
    int empty;
} svg_box;

typedef struct svg_canvas {
    svg_box view;         /* what is shown */
    double scale, x0, y0; /* pixels: (x0 + scale x, y0 - scale y) */
} svg_canvas;

/* ---- svg.c -------------------------------------------------------------------------------------- */
void svg_box_add(svg_box *box, double x, double y, double r);
/* Where a pose puts the centre of an object ball. */
void svg_place(const host_ball *ball, const cage_pose *pose, double unit, double at[3]);
double svg_fit(svg_canvas *canvas, const svg_box *box, double x, double y, double width, double height);
double svg_x(const svg_canvas *canvas, double x);
double svg_y(const svg_canvas *canvas, double y);
void svg_arrow(FILE *out); /* defines #arrow */
double svg_legend(FILE *out, double x, double y, const char *shape, const char *name);

/* ---- svg_plane.c -------------------------------------------------------------------------------- */
/* The largest distance of the object's points from its pivot. */
double svg_object_radius(const host_answer *answer);
void svg_plane_box(const host_answer *answer, svg_box *box);
/* The scene, and its legend from (x, y) to the right. */
void svg_plane(FILE *out, const svg_canvas *canvas, const host_answer *answer, double x, double y);

/* ---- svg_region.c ------------------------------------------------------------------------------- */
/* Where the pivot can be; 0 if it cannot be drawn (no memory). */
int svg_region(FILE *out, const svg_canvas *canvas, const host_answer *answer);

/* ---- svg_path.c --------------------------------------------------------------------------------- */
/* The object, faint, at poses along the path; and the line along which its pivot goes. */
void svg_path_copies(FILE *out, const svg_canvas *canvas, const host_answer *answer);
int svg_path_cut(const svg_canvas *canvas, const host_answer *answer); /* does it leave the view? */
void svg_path_line(FILE *out, const svg_canvas *canvas, const host_answer *answer);
/* The object (the symbol #object) at a pose of the user's frame, its angle in degrees. */
void svg_object(FILE *out, const svg_canvas *canvas, const char *style, const double origin[2], double degrees);

/* ---- svg_space.c -------------------------------------------------------------------------------- */
#define SVG_VIEWS 3
/* Three views of one scale, side by side in an area that wide; returns how high they are, most at most but for their labels. */
double svg_space_fit(svg_canvas canvas[SVG_VIEWS], const host_answer *answer, double x, double y, double width, double most);
/* The scene, and its legend from (x, y) to the right. */
void svg_space(FILE *out, const svg_canvas canvas[SVG_VIEWS], const host_answer *answer, double x, double y);

#endif
