/* make_table.c: writes table.h, the scenes that every machine is asked: drawn by the generators of the other tests. */
#include <stdio.h>
#include <string.h>

#include "../scenes.h"
#include "../scenes_space.h"

/* Seeds of scenes that are decided in few steps, of all verdicts and most families; the atlas's first level, -1: none is made. */
static const struct {
    int dim, seed, atlas;
} wanted[] = {{2, 0, 3},  {2, 2, -1}, {2, 5, -1}, {2, 7, -1}, {2, 8, 4},  {2, 13, -1}, {2, 16, 4}, {2, 20, -1}, {2, 21, -1},
              {2, 23, -1}, {2, 33, -1}, {2, 35, 4}, {2, 37, -1}, {2, 193, 2}, {3, 3, -1},
              {3, 9, 0},  {3, 18, -1}, {3, 21, 1}, {3, 25, -1}, {3, 33, -1}, {3, 39, -1}, {3, 41, -1}};
enum { WANTED = sizeof wanted / sizeof *wanted };

static void balls(const char *name, int number, const cage_ball *ball, int32_t count)
{
    printf("static const cage_ball %s_%d[] = {", name, number);
    int column = 128;
    for (int32_t i = 0; i < count; i++) {
        char text[64];
        int length = snprintf(text, sizeof text, "{%d, %d, %d, %d}%s", ball[i].x, ball[i].y, ball[i].z, ball[i].r,
                              i + 1 < count ? "," : "};");
        column += length + 1;
        if (column > 126) {
            printf("\n   ");
            column = 3 + length + 1;
        }
        printf(" %s", text);
    }
    printf("\n");
}

static void pose(const cage_pose *p)
{
    printf("{{%d, %d, %d}, {%d, %d, %d, %d}}", p->x[0], p->x[1], p->x[2], p->q[0], p->q[1], p->q[2], p->q[3]);
}

static cage_scene draw(int i, scene *flat, space_scene *solid, const cage_pose **start, const cage_pose **goal)
{
    if (wanted[i].dim == 2) {
        scene_random((uint64_t)wanted[i].seed, flat);
        *start = &flat->start;
        *goal = scene_goal(flat);
        return scene_view(flat);
    }
    space_random((uint64_t)wanted[i].seed, solid);
    *start = &solid->start;
    *goal = space_goal(solid);
    return space_view(solid);
}

int main(void)
{
    static scene flat;
    static space_scene solid;
    const cage_pose *start, *goal;
    printf("/* table.h: scenes of tests/scenes.c and tests/scenes_space.c as numbers, written by make_table.c. */\n");
    for (int i = 0; i < WANTED; i++) {
        cage_scene s = draw(i, &flat, &solid, &start, &goal);
        balls("object", i, s.object.inner, s.object.inner_count);
        balls("obstacle", i, s.obstacles.inner, s.obstacles.inner_count);
    }
    printf("\nstatic const struct entry table[] = {\n");
    for (int i = 0; i < WANTED; i++) {
        cage_scene s = draw(i, &flat, &solid, &start, &goal);
        printf("    {%d, %d, %d, %d, %d, %d, object_%d, obstacle_%d,\n     ", wanted[i].dim, wanted[i].seed, wanted[i].atlas,
               s.object.inner_count, s.obstacles.inner_count, goal != NULL, i, i);
        pose(start);
        printf(", ");
        pose(goal ? goal : start);
        printf("},\n");
    }
    printf("};\n");
    return 0;
}
