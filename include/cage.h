/* cage.h: prove that a rigid object made of balls cannot leave, or find its way out.
 *
 * The object is a union of balls in its own frame, the obstacles a union of balls in the world, in
 * the plane (dim 2) or in space (dim 3). Every number is an integer: lengths are in grid units of the
 * caller's choice, rotations are integer quaternions. A pose (x, R) collides when some object ball and
 * some obstacle ball overlap, |x + R y - X| < r + R; touching is allowed.
 *
 * Every verdict but UNDEFINED is a theorem about the balls given. Method: Varava, Carvalho, Pokorny,
 * Kragic, "Caging and Path Non-Existence: a Deterministic Sampling-Based Verification Algorithm",
 * ISRR 2017; where libcage differs, the source says so.
 *
 * The library takes all memory from the caller, calls nothing but memcpy, memset and memmove, keeps no state
 * between calls outside that memory, and gives the same bytes on every machine. Functions returning
 * int32_t give a negative CAGE_ERROR_... when they fail; a failed call changes nothing but scratch. */
#ifndef CAGE_H
#define CAGE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined __GNUC__ && !defined _WIN32
#pragma GCC visibility push(default) /* the shared library exports what is declared here, and nothing else */
#endif

#define CAGE_VERSION "0.1.0"
#define CAGE_ABI 1 /* changes whenever a struct or a signature below does */

/* Every scene must fit: max |X| + R over the obstacles plus max 3 |y| + r over the object (|.| the
 * Euclidean norm, y from the pivot) plus 16, and every coordinate of a pose and of its pivot, at most CAGE_REACH. */
#define CAGE_REACH_2D 178956970 /* 2^29 / 3 */
#define CAGE_REACH_3D 5592405   /* 2^24 / 3 */

/* Quaternion entries of a pose are at most this in magnitude. */
#define CAGE_QUATERNION_2D (1 << 30)
#define CAGE_QUATERNION_3D (1 << 24)

/* The finest level of cells: the plane's rotations are cut into 2 * 2^level cells, those of space into 4 * 8^level. */
#define CAGE_LEVEL_MAX_2D 14
#define CAGE_LEVEL_MAX_3D 11

/* ---- errors ------------------------------------------------------------------------------------- */
#define CAGE_OK 0
#define CAGE_ERROR_ARGUMENT (-1)  /* a null pointer, a negative count, an unknown constant */
#define CAGE_ERROR_DIMENSION (-2) /* dim is not supported, or z is not 0 in the plane */
#define CAGE_ERROR_RANGE (-3)     /* the scene or a pose does not fit CAGE_REACH */
#define CAGE_ERROR_RADIUS (-4)    /* a negative radius */
#define CAGE_ERROR_ROTATION (-5)  /* a quaternion of zero, too large, or not about z in the plane */
#define CAGE_ERROR_ATLAS (-7)     /* the bytes are no atlas (or facts) of this version, or were changed */
#define CAGE_ERROR_MEMORY (-6)    /* the block is too small: to begin see cage_prove_size, once begun cage_result.needed_bytes */

/* ---- verdicts ----------------------------------------------------------------------------------- */
#define CAGE_UNDEFINED 0    /* a limit was reached first, or the work is not finished: see reason */
#define CAGE_CAGED 1        /* proved: no path leads from the start to arbitrarily far away */
#define CAGE_DISCONNECTED 2 /* proved: no path joins start and goal */
#define CAGE_FREE 3         /* proved, by a path, that the object can leave */
#define CAGE_CONNECTED 4    /* proved, by a path from start to goal */
#define CAGE_IN_COLLISION 5 /* the start or the goal itself collides */

/* ---- what a verdict rests on -------------------------------------------------------------------- */
#define CAGE_REASON_RUNNING 0     /* cage_prove_run has more to do */
#define CAGE_REASON_CLOSED 1      /* the reached part of the inner slices is closed */
#define CAGE_REASON_PATH 2        /* a certified path */
#define CAGE_REASON_START 3       /* the start collides */
#define CAGE_REASON_GOAL 4        /* the goal collides */
#define CAGE_REASON_LEVEL 5       /* undefined: every cell on every way is as fine as max_level allows */
#define CAGE_REASON_CELLS 6       /* undefined: max_cells are in use */
#define CAGE_REASON_SIDE 7        /* undefined: the one side that was asked for cannot decide */

/* ---- input --------------------------------------------------------------------------------------- */

/* A closed ball: centre and radius in grid units; z is 0 in the plane. */
typedef struct cage_ball {
    int32_t x, y, z, r;
} cage_ball;

/* A solid, seen from both sides: every inner ball lies inside it, the outer balls together cover
 * it. Separation is proved about the inner balls, paths about the outer ones. Balls that are the
 * solid are given twice (the same pointer will do). Counts may be 0; the balls stay the caller's. */
typedef struct cage_shape {
    const cage_ball *inner; /* inner_count balls */
    const cage_ball *outer; /* outer_count balls */
    int32_t inner_count;
    int32_t outer_count;
} cage_shape;

typedef struct cage_scene {
    cage_shape object;    /* in the object's frame */
    cage_shape obstacles; /* in the world */
    int32_t dim;          /* 2 or 3 */
} cage_scene;

/* A pose takes the point y of the object to x + R(q) y. The quaternion q = (w, x, y, z) need not be
 * of unit length, q and -q are the same; in the plane q = (w, 0, 0, z) turns by 2 atan2(z, w). */
typedef struct cage_pose {
    int32_t x[3];
    int32_t q[4];
} cage_pose;

#define CAGE_SIDE_INNER 1 /* look for a proof of CAGED / DISCONNECTED only */
#define CAGE_SIDE_OUTER 2 /* look for a path only */
#define CAGE_SIDE_BOTH 3

/* Limits of a search. cage_limits_default fills in values that decide ordinary scenes in seconds. */
typedef struct cage_limits {
    int32_t side;        /* CAGE_SIDE_... */
    int32_t start_level; /* the cells' first level, or -1: chosen from the balls */
    int32_t max_level;   /* 0 to CAGE_LEVEL_MAX */
    int32_t max_cells;   /* cells ever made: at least those down to start_level (2, 6, 14, ...; in space 4, 36,
                            292, ...), at most 2^24 */
} cage_limits;

/* ---- output -------------------------------------------------------------------------------------- */

/* Counts of work are a function of scene, query and limits alone. Index 0 is the inner side, 1 the outer. */
typedef struct cage_result {
    int32_t verdict;        /* CAGE_CAGED, ... */
    int32_t reason;         /* CAGE_REASON_... */
    int32_t level;          /* of the finest cell made */
    int32_t cells;          /* cells made, refined ones included; without a goal, up to half turns that leave the object's balls
                               where they are */
    int32_t slices[2];      /* slices built */
    int32_t gluings[2];     /* pairs of neighbouring slices glued, counted for each connected group of components */
    int32_t mixtures[2];    /* gluings that needed a triangulation of their own */
    int32_t reached[2];     /* (cell, component) nodes reached from the start when the search ended */
    int64_t balls[2];       /* collision balls of all slices */
    int64_t inserted[2];    /* of these, the ones triangulated (the rest is covered by them); after cage_prove_begin_small some twice */
    int64_t steps;          /* steps taken */
    uint64_t peak_bytes;    /* most bytes of the block in use at once, slices held in store and the path not
                               counted; may vary with the block */
    uint64_t needed_bytes;  /* after CAGE_ERROR_MEMORY: the block to try next, larger; the same step may ask for still more */
    int32_t pivot[3];       /* the point of the object that rotations are about, in the object's frame */
    int32_t path_count;     /* poses on the path, 0 where there is none */
    const cage_pose *path;  /* in the caller's block; x is where the PIVOT is: see cage_path_check */
} cage_result;

/* ---- poses --------------------------------------------------------------------------------------- */

/* Does the scene fit (see CAGE_REACH)? CAGE_OK or the error that cage_prove_begin would give. */
int32_t cage_scene_check(const cage_scene *scene);

/* Does the object at this pose (user's frame) collide? 1 or 0, exact, or an error. side: CAGE_SIDE_INNER
 * for the inner balls of object and obstacles, CAGE_SIDE_OUTER for the outer ones. */
int32_t cage_collides(const cage_scene *scene, const cage_pose *pose, int32_t side);

/* ---- proofs -------------------------------------------------------------------------------------- */

typedef struct cage_proof cage_proof; /* lives at the start of the caller's block */

void cage_limits_default(cage_limits *limits, int32_t dim);

/* Bytes that are enough for a proof of this scene to begin, at any alignment, and as a rule to finish (if not, see needed_bytes): up
 * to twice what a usual one has in use at once. More memory never changes an answer, but saves building slices twice: on a machine
 * that has it give four times that. Limits null: the default ones. 0 if the scene or the limits are not valid. */
size_t cage_prove_size(const cage_scene *scene, const cage_limits *limits);

/* The same as a constant expression, for a block that is an array: never less than cage_prove_size (if it fits a size_t), and at
 * most 1.2 times that; in space 3.1 times where there is but one search, as one side alone is asked for, or max_cells is too few
 * for two from the start level on; somewhat more where pointers have 32 bits. For shapes whose inner and outer counts are not more
 * than these, and limits with that many cells. */
#define CAGE_PROVE_BYTES(dim, objects, obstacles, max_cells)                                                              \
    ((dim) == 2 ? CAGE_PROVE_BYTES_OF_ONE(objects, (size_t)300 * (objects) * (obstacles), (size_t)1 * (max_cells))        \
                : CAGE_PROVE_BYTES_OF_TWO(                                                                                \
                      CAGE_PROVE_BYTES_OF_ONE(objects, (size_t)900 * (objects) * (obstacles), (size_t)1 * (max_cells)), \
                      CAGE_PROVE_BYTES_OF_ONE(objects, (size_t)900 * (objects) * (obstacles), (size_t)(max_cells) / 8)))
#define CAGE_PROVE_BYTES_OF_ONE(objects, work, cells) (43520 + (size_t)64 * (objects) + (work) + 144 * (cells))
#define CAGE_PROVE_BYTES_OF_TWO(first, second) ((first) > 2 * (second) ? (first) / 2 * 3 + 64 : 3 * (second) + 64)

/* Ask: can the object leave the start (goal null), or get from start to goal? The scene's balls are
 * read until the proof is finished; memory (any alignment) is used until the result was read. Limits null: the default
 * ones. When this fails *proof is not written, so after CAGE_ERROR_MEMORY there is no result to read needed_bytes from:
 * ask cage_prove_size, a block of that size is never too small to begin. */
int32_t cage_prove_begin(cage_proof **proof, const cage_scene *scene, const cage_pose *start,
                         const cage_pose *goal, const cage_limits *limits, void *memory, size_t bytes);

/* The same for CAGE_SIDE_INNER alone (limits null: the default ones, but that side; another: CAGE_ERROR_ARGUMENT), without what
 * only makes a proof faster: an image that proves cages with this and cage_prove_run_inner has about a fifth less code, and takes
 * half as long again or, where few balls cover all others, several times as long. A slice triangulates at most 2 n m balls
 * (see cage_prove_run). Both ways prove the same theorems; but counts, and what is left undecided at the limits, may differ.
 * cage_prove_size holds as well. */
int32_t cage_prove_begin_small(cage_proof **proof, const cage_scene *scene, const cage_pose *start,
                               const cage_pose *goal, const cage_limits *limits, void *memory, size_t bytes);

/* Do at most that many steps; a step builds one slice, glues one pair of slices, refines one cell, or writes or shortens one
 * leg of a path. With n object balls and m obstacle balls a slice triangulates at most n m balls. A gluing triangulates at most
 * 2 n m, balls of both slices, for each pair of components that nothing simpler decides, before that two slices that were
 * dropped, at worst twice (and all of it again each time that a block of hardly enough bytes has to be shared out anew, or the
 * pairs are more than expected). Most gluings have no such pair or one, so that a step takes 6 n m; 344 of them, 154 n m in
 * all, were seen where balls that just touch leave many pinholes. Beside that a step goes through cells and known edges, and
 * the last one of a path checks all of it. 1: finished, 0: more to do, negative: an error (the result keeps its counts, and
 * needed_bytes). The answer does not depend on how the steps are portioned. */
int32_t cage_prove_run(cage_proof *proof, int64_t steps);

/* The same for a proof that was begun with limits of CAGE_SIDE_INNER (else CAGE_ERROR_ARGUMENT): every byte of the result is the
 * same. An image that calls this one instead carries nothing that looks for paths, about a sixth of the code. */
int32_t cage_prove_run_inner(cage_proof *proof, int64_t steps);

/* Several cores for one proof. run calls task(data, i, w) once for each i in 0..tasks - 1, in any order, all at once
 * if it can; w is 0 to count - 1, and no two calls at the same time have the same w. It returns when all have. */
typedef struct cage_workers {
    int32_t count; /* 1 to 64 */
    void (*run)(void *context, int32_t tasks, void (*task)(void *data, int32_t index, int32_t worker), void *data);
    void *context;
    void *memory; /* for the workers to share, between calls not used: some 100 times what the largest slice takes */
    size_t bytes; /* with too few of them the workers help less, or not at all */
} cage_workers;

/* The same with workers (or null), which make slices and gluings before their turn comes. The answer does not depend
 * on them: every byte of the result is the same, path and counts included. */
int32_t cage_prove_run_with(cage_proof *proof, int64_t steps, const cage_workers *workers);

/* The result so far (null for null); verdict is CAGE_UNDEFINED until cage_prove_run returned 1. */
const cage_result *cage_prove_result(const cage_proof *proof);

/* Where can the pivot be? mask[i + nx (j + ny k)] becomes 1 where the point origin + pitch (i, j, k) lies in
 * the reached part of the inner slices for some rotation, else 0; count = {nx, ny, nz}, nz = 1 in
 * the plane, origin[2] = 0. Builds slices again: takes as long as a part of the proof. For pictures and statistics. After
 * CAGE_ERROR_MEMORY the mask is incomplete. */
int32_t cage_prove_region(cage_proof *proof, const int32_t origin[3], int32_t pitch,
                          const int32_t count[3], uint8_t *mask);

/* ---- candidates ----------------------------------------------------------------------------------- */

/* One step of the inner way: a component of the slice of the cell whose representative rotation is q. */
typedef struct cage_step {
    int32_t q[4];
    int32_t level;     /* of the cell; -1: the rotation of start or goal alone */
    int32_t component; /* of its inner slice; 0: the outside */
    int32_t pose;      /* the first on the path over this cell */
} cage_step;

/* After UNDEFINED, with the inner side: a way that the inner slices leave open (which a proof would have to close), as the
 * sequence of (component, slice) pairs and as a decomposable path of the pivot, like cage_result.path. A CANDIDATE: balls made
 * smaller can go it (each by how far it moves within the cells), the object itself may collide on it, and cage_path_check tells.
 * count: {steps, poses} there are; what there is no room for is not written. 1: found; 0: there is none, or the answer was another;
 * CAGE_ERROR_ARGUMENT also before the proof has ended; after CAGE_ERROR_MEMORY needed_bytes says what block to try the proof in,
 * and what was written is no candidate. Builds slices again. It changes no other answer: result and region stay as they were. */
int32_t cage_prove_candidate(cage_proof *proof, cage_step *step, int32_t steps, cage_pose *path, int32_t poses,
                             int32_t count[2]);

/* ---- margin -------------------------------------------------------------------------------------- */

/* By how much every radius must shrink (negative: may grow) for the answer to change, the balls smaller than that gone:
 * shrunk by `closed` the question is answered CAGED, DISCONNECTED or IN_COLLISION, by `open` FREE or CONNECTED. */
typedef struct cage_margin {
    int32_t closed;   /* the largest found, */
    int32_t open;     /* and the smallest; what lies between was not asked or not decided */
    int32_t proofs;   /* how many it took */
    int32_t bounded;  /* 1; 0: grown as far as the grid allows it was not closed, and `closed` says nothing */
    int32_t known;    /* 1: narrow is set */
    int32_t pivot[3]; /* of the object, as in cage_result */
    cage_pose narrow; /* on the path found for `open`, its poses and straight legs: where the balls as given come closest, or
                         overlap most (x is where the pivot is) */
} cage_margin;

/* Find it with so many proofs by bisection, as many as the first bounds take, and one for `narrow`. The number that ranks
 * grasps: how tight a cage is. All memory is scratch. Errors of cage_prove_begin and cage_prove_run; then *out is not
 * written. Radii shrink ball by ball: where the inner and the outer balls of a shape differ much in size, the margin is one
 * of these balls, not of the shape. */
int32_t cage_margin_find(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, const cage_limits *limits,
                         int32_t rounds, void *memory, size_t bytes, cage_margin *out);

/* ---- paths --------------------------------------------------------------------------------------- */

/* A path is a sequence of poses of the pivot: the object's ball (y, r) sits at x + R(q)(y - pivot).
 * From each pose to the next the pivot moves on a straight line while the object turns about it along the shorter arc, both
 * at a constant rate. On a path that cage_prove found, x or q (up to scale) stays: it moves or turns, not both.
 * The first pose is the start, its pivot moved
 * to a grid point less than 1 unit away; with a goal the last pose is the goal, likewise. Without one, at the last pose
 * the whole object is beyond an axis-parallel line (plane) that has all obstacles on its other side.
 *
 * Coordinates may be beyond CAGE_REACH, far outside.
 *
 * 1 when the whole motion, the moves from start and to goal included, is proved free of collision for the outer
 * balls as given, continuous in time; 0 when it is not; or an error. Shares no code with the search. */
int32_t cage_path_check(const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                        const int32_t pivot[3], const cage_pose *path, int32_t count);

/* ---- atlas: making ------------------------------------------------------------------------------- */

/* An atlas is the connectivity of a whole scene, made once and asked many times: all cells, the components of their slices, the
 * graph of those that share points, and its connected classes, on the inner side and on the outer (the paper's
 * Algorithms 1 to 4). It is a string of bytes, the same on every machine, that may lie anywhere: in a file, in flash. */

typedef struct cage_plan {
    int32_t side;      /* CAGE_SIDE_...: with INNER it proves separation only, with OUTER connection only */
    int32_t level;     /* of all cells to begin with: 0 to 14, in space to 7 (2^24 cells), or -1: chosen from the balls */
    int32_t max_cells; /* 0: that is all; else, with both sides, cells are cut until no more than that would be made: those first
                          where the sides disagree on what is connected, of these the coarsest */
    int32_t note[2];   /* the caller's: comes back in cage_atlas */
} cage_plan;

/* Index 0 is the inner side, 1 the outer. */
typedef struct cage_survey_result {
    int32_t level;         /* of the finest cell */
    int32_t cells;         /* cells made, those that were cut included */
    int32_t leaves;        /* those that were not */
    int32_t slices[2];     /* slices built */
    int32_t gluings[2];    /* pairs of neighbouring slices glued */
    int32_t mixtures[2];   /* gluings that needed a triangulation of their own */
    int32_t classes[2];    /* connected classes; these and atlas_bytes are 0 until it is finished */
    int64_t balls[2];      /* collision balls of all slices */
    int64_t inserted[2];   /* of these, the ones triangulated */
    int64_t steps;         /* slices, gluings, and rounds of cutting */
    uint64_t atlas_bytes;  /* of the atlas */
    uint64_t peak_bytes;   /* most bytes of the block in use at once, slices held in store not counted */
    uint64_t needed_bytes; /* after CAGE_ERROR_MEMORY: the block to try next, larger; it may ask for still more */
} cage_survey_result;

typedef struct cage_survey cage_survey; /* lives at the start of the caller's block */

void cage_plan_default(cage_plan *plan);

/* Bytes that are enough for a survey to begin, at any alignment, and often to finish (if not, see needed_bytes): up to twice what a
 * usual one has in use at once, its atlas included. 0 if scene or plan are not valid. */
size_t cage_survey_size(const cage_scene *scene, const cage_plan *plan);

/* The same as a constant expression, for a block that is an array: never less (if it fits a size_t), at most 1.4 times that where
 * both sides are asked for (2.2 times with max_cells in the plane; somewhat more where pointers have 32 bits). For shapes with no
 * more balls than these on either side. slices: of one side, those of the cells of the plan's level (in the plane 2, 4, 8, ...,
 * in space 4, 32, 256, ...), or with max_cells as many. */
#define CAGE_SURVEY_BYTES(dim, objects, obstacles, slices)                                                                \
    (128 * CAGE_SURVEY_CELLS(dim, slices) + (size_t)32 * (obstacles) +                                                    \
     CAGE_PROVE_BYTES_OF_ONE(objects, ((dim) == 2 ? (size_t)300 : (size_t)900) * (objects) * (obstacles),                 \
                             CAGE_SURVEY_CELLS(dim, slices)) - (16384 - 896) +                                            \
     (size_t)2 * (slices) * (((dim) == 2 ? (size_t)24 : (size_t)22) * (objects) * (obstacles) + 256))
#define CAGE_SURVEY_CELLS(dim, slices) ((dim) == 2 ? (size_t)2 * (slices) : (size_t)(slices) + (size_t)(slices) / 7 + 1)

/* The scene's balls are read until the atlas was written; memory (any alignment) is used until then. */
int32_t cage_survey_begin(cage_survey **survey, const cage_scene *scene, const cage_plan *plan, void *memory, size_t bytes);

/* Do at most that many steps. 1: finished, 0: more to do, or an error. The atlas does not depend on how they are portioned,
 * nor on the block. */
int32_t cage_survey_run(cage_survey *survey, int64_t steps);

/* The same with workers (or null), see cage_prove_run_with: every byte of the atlas is the same. */
int32_t cage_survey_run_with(cage_survey *survey, int64_t steps, const cage_workers *workers);

const cage_survey_result *cage_survey_result_of(const cage_survey *survey);

/* The size of the finished atlas (0: it is not finished), written to out (aligned to 4 bytes or not) if it has as many bytes. */
size_t cage_survey_atlas(const cage_survey *survey, void *out, size_t bytes);

/* What was found out so far, and the cells that were cut, as bytes: a build that is interrupted goes on from them, on whatever
 * machine. The size, written to out (aligned or not) if it has as many bytes; at any time, after an error too. */
size_t cage_survey_facts(const cage_survey *survey, void *out, size_t bytes);

/* Take over such facts, once or several times, before the first step: the atlas is the same, what they tell is not worked out
 * again (nor counted in the result). CAGE_ERROR_ATLAS, and nothing is taken, if the bytes were changed or are those of another
 * scene, another plan or another version: facts are believed. After CAGE_ERROR_MEMORY see needed_bytes, and begin anew. */
int32_t cage_survey_learn(cage_survey *survey, const void *bytes, size_t size);

/* Before the first step: work on a part only, one of so many; 1 from cage_survey_run then means that all its slices are built
 * and glued with each other. There is no atlas; facts are what it is for: a survey that learns those of all parts, made
 * anywhere, has left to do what is between them. */
int32_t cage_survey_part(cage_survey *survey, int32_t part, int32_t parts);

/* ---- atlas: asking ------------------------------------------------------------------------------- */

/* An opened atlas: the caller's bytes, which must stay. */
typedef struct cage_atlas {
    const unsigned char *byte;
    int32_t words;
    int32_t dim;
    int32_t side;       /* CAGE_SIDE_...: what it can answer for */
    int32_t classes[2]; /* on the inner side and on the outer; class 0 is the outside's */
    int32_t nodes[2];   /* (cell, component) pairs */
    int32_t leaves;     /* cells */
    int32_t pivot[3];   /* the point of the object that rotations are about */
    int32_t note[2];
} cage_atlas;

/* What a class is. All translations of the pivot that belong to it are within low..high (zeros for class 0, which goes on for
 * ever), all rotations within an angle of the rotation q: the sine of half of it is sine / 2^30, rounded up (2^30: they may be
 * any). pose: a pose of the pivot in it, if known is 1. */
typedef struct cage_class {
    int32_t cells;
    int32_t nodes;
    int32_t low[3], high[3];
    int32_t q[4];
    int32_t sine;
    int32_t known;
    cage_pose pose;
} cage_class;

/* Check all of it and open it: CAGE_ERROR_ATLAS if the bytes are not an atlas, cut off or changed. Reads every byte once. */
int32_t cage_atlas_open(cage_atlas *atlas, const void *bytes, size_t size);

/* What is proved about the start (goal null), or start and goal, user's frame: a verdict, exact on the borders of cells as
 * well, or an error. What cage_prove_begin with any limits answers is never another one, but one of both may be UNDEFINED.
 * Reads as a rule a few hundred words of the atlas; at most 7000 for each pose, side and cell that holds its rotation, of
 * which there are 2 at most in the plane and 8 in space (and the balls, where neither side tells whether they overlap).
 * Optimised for size or speed it takes less than 2 KB of stack. */
int32_t cage_atlas_ask(const cage_atlas *atlas, const cage_pose *start, const cage_pose *goal);

/* The class of a pose on one side, or CAGE_NO_CLASS where balls cover it: on the inner side it then collides. */
#define CAGE_NO_CLASS (-1000)
int32_t cage_atlas_locate(const cage_atlas *atlas, const cage_pose *pose, int32_t side);

int32_t cage_atlas_class(const cage_atlas *atlas, int32_t side, int32_t class_number, cage_class *out);

/* The corners of a cell, 0 <= cell < atlas->leaves: quaternions, 2 in the plane and 8 in space, corner k at the high end of
 * axis i if bit i of k is set. The cell's rotations are those between them: their quaternions are sums of positive multiples
 * of the corners. q: its representative rotation. Returns how many corners it has. */
int32_t cage_atlas_cell(const cage_atlas *atlas, int32_t cell, int32_t q[4], int32_t corner[8][4]);

/* A solid box of translations of the pivot. */
typedef struct cage_atlas_box {
    int32_t low[3], high[3];
    int32_t whole; /* 1: all of it belongs to the class over all of the cell, 0: part of it may */
} cage_atlas_box;

typedef void cage_visit(void *context, const cage_atlas_box *box);

/* Visit boxes that between them hold all translations that belong to the class over the cell (of class 0 those within the
 * bounding box of the cell's balls), but for gaps of one unit between boxes. Boxes of which only part may belong to it are
 * halved along each axis to find out, down to 1 / 2^halvings (0 to 20) of the size of the class (or of that box). For volumes
 * and pictures. How many were visited, or an error. */
int64_t cage_atlas_boxes(const cage_atlas *atlas, int32_t side, int32_t cell, int32_t class_number, int32_t halvings,
                         cage_visit *visit, void *context);

/* ---- bindings ------------------------------------------------------------------------------------ */

/* What a program that read no header (a binding in another language) compares with its own tables before it calls anything
 * else: CAGE_ABI of this library, and the size of a struct above, 0 for an unknown number. */
#define CAGE_STRUCT_BALL 0
#define CAGE_STRUCT_SHAPE 1
#define CAGE_STRUCT_SCENE 2
#define CAGE_STRUCT_POSE 3
#define CAGE_STRUCT_LIMITS 4
#define CAGE_STRUCT_RESULT 5
#define CAGE_STRUCT_WORKERS 6
#define CAGE_STRUCT_MARGIN 7
#define CAGE_STRUCT_PLAN 8
#define CAGE_STRUCT_SURVEY_RESULT 9
#define CAGE_STRUCT_ATLAS 10
#define CAGE_STRUCT_CLASS 11
#define CAGE_STRUCT_BOX 12
#define CAGE_STRUCT_STEP 13
int32_t cage_abi(void);
size_t cage_struct_size(int32_t which);

/* ---- words --------------------------------------------------------------------------------------- */
const char *cage_verdict_text(int32_t verdict); /* "CAGED", ... */
const char *cage_reason_text(int32_t reason);
const char *cage_error_text(int32_t error);

#if defined __GNUC__ && !defined _WIN32
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
