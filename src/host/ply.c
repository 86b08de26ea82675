/* ply.c: a scene in space as a mesh with colours, in ASCII PLY: balls as icospheres, the pivot's region as small cubes.
 *
 * Obstacles are grey (their alpha lets viewers that know it look inside), the object is blue at the start, orange at
 * the goal, and on its way from violet to yellow; what collides is red. Where the pivot stays for ever is a skin of
 * small green cubes. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"

#define STOPS 40       /* objects along the path at most */
#define WAY_BALLS 6000 /* balls of all of them, about */
#define FEW 400        /* so many balls in all are drawn with 320 triangles each, more with 80 */
#define CUBE 0.4       /* size of a cube, of the way to the next one */
#define VERTICES 162   /* of the finer sphere */
#define FACES 320

typedef struct colour {
    unsigned char part[4]; /* red, green, blue, alpha */
} colour;

typedef struct part {
    double x[3], r; /* half the side of a cube */
    colour paint;
} part;

typedef struct mesh {
    part *ball, *cube;
    int32_t balls, cubes;
} mesh;

typedef struct sphere {
    double vertex[VERTICES][3];
    int face[FACES][3];
    int vertices, faces;
} sphere;

static const colour grey = { { 150, 157, 166, 110 } }, blue = { { 47, 111, 208, 255 } }, orange = { { 240, 150, 50, 255 } };
static const colour red = { { 220, 60, 60, 255 } }, green = { { 90, 190, 80, 255 } };

/* ---- shapes ------------------------------------------------------------------------------------------ */

static int add_vertex(sphere *ball, double x, double y, double z)
{
    const double size = sqrt(x * x + y * y + z * z), at[3] = { x / size, y / size, z / size };
    int i;

    for (i = 0; i < ball->vertices; i++)
        if (fabs(ball->vertex[i][0] - at[0]) + fabs(ball->vertex[i][1] - at[1]) + fabs(ball->vertex[i][2] - at[2]) < 1e-6)
            return i;
    memcpy(ball->vertex[i], at, sizeof at);
    ball->vertices++;
    return i;
}

static int middle(sphere *ball, int a, int b)
{
    const double *p = ball->vertex[a], *q = ball->vertex[b];

    return add_vertex(ball, p[0] + q[0], p[1] + q[1], p[2] + q[2]);
}

/* Four triangles for each. */
static void divide(sphere *ball)
{
    int i, k, old[FACES][3], count = ball->faces;

    memcpy(old, ball->face, sizeof old);
    ball->faces = 0;
    for (i = 0; i < count; i++) {
        const int *f = old[i];
        const int ab = middle(ball, f[0], f[1]), bc = middle(ball, f[1], f[2]), ca = middle(ball, f[2], f[0]);
        const int quarter[4][3] = { { f[0], ab, ca }, { f[1], bc, ab }, { f[2], ca, bc }, { ab, bc, ca } };

        for (k = 0; k < 4; k++)
            memcpy(ball->face[ball->faces++], quarter[k], sizeof quarter[k]);
    }
}

/* An icosahedron of unit size, each triangle divided that many times, seen from outside counter-clockwise. */
static void make_sphere(sphere *ball, int times)
{
    static const int face[20][3] = {
        { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 }, { 1, 5, 9 }, { 5, 11, 4 },
        { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 }, { 3, 2, 6 }, { 3, 6, 8 },
        { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 }, { 9, 8, 1 },
    };
    static const int corner[12][3] = { /* 2 stands for the golden ratio */
        { -1, 2, 0 }, { 1, 2, 0 }, { -1, -2, 0 }, { 1, -2, 0 }, { 0, -1, 2 }, { 0, 1, 2 },
        { 0, -1, -2 }, { 0, 1, -2 }, { 2, 0, -1 }, { 2, 0, 1 }, { -2, 0, -1 }, { -2, 0, 1 },
    };
    const double golden = (1 + sqrt(5)) / 2;
    double at[3];
    int i, k;

    memset(ball, 0, sizeof *ball);
    for (i = 0; i < 12; i++) {
        for (k = 0; k < 3; k++)
            at[k] = corner[i][k] == 2 ? golden : corner[i][k] == -2 ? -golden : corner[i][k];
        (void)add_vertex(ball, at[0], at[1], at[2]);
    }
    memcpy(ball->face, face, sizeof face);
    ball->faces = 20;
    while (times-- > 0)
        divide(ball);
}

/* Its corners by the bits of their numbers: x, y, z. */
static const int cube_face[12][3] = {
    { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
    { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 },
};

/* ---- the parts --------------------------------------------------------------------------------------- */

static void add_object(mesh *made, const host_answer *answer, const picture_stop *stop, colour paint)
{
    const host_balls *object = &answer->query->object;
    int32_t i;

    for (i = 0; i < object->count; i++) {
        part *ball = &made->ball[made->balls++];

        picture_place(answer, stop, &object->ball[i], ball->x);
        ball->r = object->ball[i].r;
        ball->paint = paint;
    }
}

/* Along the way: violet, blue-green, green, yellow. */
static colour ramp(double t)
{
    static const double at[4][3] = { { 112, 60, 160 }, { 33, 145, 140 }, { 94, 201, 98 }, { 253, 231, 37 } };
    const int i = t >= 1 ? 2 : (int)(3 * t);
    colour paint = { { 0, 0, 0, 255 } };
    int k;

    for (k = 0; k < 3; k++)
        paint.part[k] = (unsigned char)(at[i][k] + (3 * t - i) * (at[i + 1][k] - at[i][k]));
    return paint;
}

static void add_balls(mesh *made, const host_answer *answer, const picture_stop *way, int stops)
{
    const host_balls *obstacles = &answer->query->obstacles;
    const int hit = answer->result->verdict == CAGE_IN_COLLISION, goal_hit = hit && answer->result->reason == CAGE_REASON_GOAL;
    picture_stop stop;
    int32_t i;

    for (i = 0; i < obstacles->count; i++) {
        part *ball = &made->ball[made->balls++];

        memcpy(ball->x, obstacles->ball[i].x, sizeof ball->x);
        ball->r = obstacles->ball[i].r;
        ball->paint = grey;
    }
    picture_stop_at(answer, &answer->grid->start, &stop);
    add_object(made, answer, &stop, hit && !goal_hit ? red : blue);
    if (answer->query->has_goal) {
        picture_stop_at(answer, &answer->grid->goal, &stop);
        add_object(made, answer, &stop, goal_hit ? red : orange);
    }
    for (i = 0; i < stops; i++)
        add_object(made, answer, &way[i], ramp((i + 1.0) / stops));
}

/* The marked points with a neighbour that is not; made null: only counts them. */
static int32_t add_cubes(mesh *made, const picture_cloud *cloud, double unit)
{
    const int32_t *count = cloud->count;
    int32_t at[3], skin = 0;
    int k;

    for (at[2] = 0; at[2] < count[2]; at[2]++)
        for (at[1] = 0; at[1] < count[1]; at[1]++)
            for (at[0] = 0; at[0] < count[0]; at[0]++) {
                const int32_t i = at[0], j = at[1], l = at[2];

                if (!picture_marked(cloud, i, j, l) ||
                    (picture_marked(cloud, i - 1, j, l) && picture_marked(cloud, i + 1, j, l) &&
                     picture_marked(cloud, i, j - 1, l) && picture_marked(cloud, i, j + 1, l) &&
                     picture_marked(cloud, i, j, l - 1) && picture_marked(cloud, i, j, l + 1)))
                    continue;
                if (made != NULL) {
                    part *cube = &made->cube[skin];

                    for (k = 0; k < 3; k++)
                        cube->x[k] = (cloud->origin[k] + (double)cloud->pitch * at[k]) * unit;
                    cube->r = CUBE / 2 * cloud->pitch * unit;
                    cube->paint = green;
                }
                skin++;
            }
    return skin;
}

/* 0, or -1 where there is no memory. */
static int make_mesh(mesh *made, const host_answer *answer)
{
    const int32_t object = answer->query->object.count;
    const int most = (int)fmax(4, fmin(STOPS, (double)WAY_BALLS / ((double)object + 1)));
    picture_stop way[STOPS];
    picture_box box;
    int stops;
    size_t balls, cubes;

    picture_scene_box(answer, &box);
    picture_grow(&box, 2 * picture_radius(answer));
    stops = picture_trail(answer, &box, way, most);
    balls = (size_t)answer->query->obstacles.count + (size_t)object * (size_t)(stops + 2);
    cubes = answer->cloud != NULL ? (size_t)add_cubes(NULL, answer->cloud, 1) : 0;
    if (balls >= INT32_MAX / VERTICES)
        return -1;
    made->ball = malloc((balls + 1) * sizeof *made->ball);
    made->cube = malloc((cubes + 1) * sizeof *made->cube);
    if (made->ball == NULL || made->cube == NULL)
        return -1;
    add_balls(made, answer, way, stops);
    if (answer->cloud != NULL)
        made->cubes = add_cubes(made, answer->cloud, answer->grid->unit);
    return 0;
}

/* ---- the file ------------------------------------------------------------------------------------------ */

static void write_vertex(FILE *out, const part *of, double x, double y, double z)
{
    const unsigned char *paint = of->paint.part;

    (void)fprintf(out, "%.7g %.7g %.7g %d %d %d %d\n", of->x[0] + of->r * x, of->x[1] + of->r * y, of->x[2] + of->r * z, paint[0],
                  paint[1], paint[2], paint[3]);
}

static void write_faces(FILE *out, int32_t first, const int (*face)[3], int count)
{
    int i;

    for (i = 0; i < count; i++)
        (void)fprintf(out, "3 %ld %ld %ld\n", (long)first + face[i][0], (long)first + face[i][1], (long)first + face[i][2]);
}

static void write_mesh(FILE *out, const mesh *made, const sphere *ball, const host_answer *answer)
{
    int32_t i;
    int k;

    (void)fprintf(out, "ply\nformat ascii 1.0\ncomment %s: obstacles grey, object at the start blue%s\n",
                  answer->name != NULL ? answer->name : cage_verdict_text(answer->result->verdict),
                  answer->query->has_goal ? ", at the goal orange" : "");
    (void)fprintf(out, "element vertex %ld\nproperty float x\nproperty float y\nproperty float z\n"
                       "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n",
                  (long)made->balls * ball->vertices + (long)made->cubes * 8);
    (void)fprintf(out, "element face %ld\nproperty list uchar int vertex_indices\nend_header\n",
                  (long)made->balls * ball->faces + (long)made->cubes * 12);
    for (i = 0; i < made->balls; i++)
        for (k = 0; k < ball->vertices; k++)
            write_vertex(out, &made->ball[i], ball->vertex[k][0], ball->vertex[k][1], ball->vertex[k][2]);
    for (i = 0; i < made->cubes; i++)
        for (k = 0; k < 8; k++)
            write_vertex(out, &made->cube[i], k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    for (i = 0; i < made->balls; i++)
        write_faces(out, i * ball->vertices, ball->face, ball->faces);
    for (i = 0; i < made->cubes; i++)
        write_faces(out, made->balls * ball->vertices + 8 * i, cube_face, 12);
}

int host_write_ply(const char *path, const host_answer *answer, host_error *error)
{
    mesh made = { NULL, NULL, 0, 0 };
    int code = make_mesh(&made, answer) < 0 ? host_fail(error, HOST_MEMORY, "--ply: no memory for the mesh") : HOST_OK;
    FILE *out = code == HOST_OK ? fopen(path, "w") : NULL;
    sphere ball;
    int broken;

    if (out != NULL) {
        make_sphere(&ball, made.balls > FEW ? 1 : 2);
        write_mesh(out, &made, &ball, answer);
        broken = ferror(out);
        broken = fclose(out) != 0 || broken;
        if (broken)
            code = host_fail(error, HOST_BAD_INPUT, "--ply: %.600s could not be written whole", path);
    } else if (code == HOST_OK) {
        code = host_fail(error, HOST_BAD_INPUT, "--ply: %.600s cannot be written: %.200s", path, strerror(errno));
    }
    free(made.ball);
    free(made.cube);
    return code;
}
