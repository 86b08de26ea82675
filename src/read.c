/* read: the words of an atlas, wherever they lie and whatever they are; opening it, which checks them. */
#include "read.h"
#include "body.h"
#include "chart.h"

int32_t cage_read_length(const cage_atlas *atlas, uint32_t at)
{
    int32_t length = cage_words_number(cage_read_word(atlas, at)), reach = atlas->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    return length > reach ? reach : length < -reach ? -reach : length;
}

cage_ball cage_read_ball(const cage_atlas *atlas, uint32_t at)
{
    const uint32_t dim = (uint32_t)atlas->dim;
    const cage_ball ball = {cage_read_length(atlas, at), cage_read_length(atlas, at + 1),
                            dim == 3 ? cage_read_length(atlas, at + 2) : 0, cage_read_length(atlas, at + dim)};
    return ball;
}

bool cage_read_cell(const cage_atlas *atlas, uint32_t leaf, struct cage_cell *cell)
{
    const int32_t finest = atlas->dim == 2 ? CAGE_LEVEL_MAX_2D : CAGE_LEVEL_MAX_3D;
    const uint32_t roots = atlas->dim == 2 ? CAGE_ROOTS_2D : CAGE_ROOTS_3D;
    uint32_t at = cage_read_word(atlas, CAGE_ATLAS_LEAF) + 4 * leaf, head = cage_read_word(atlas, at);
    bool sound = (int32_t)(head & 15) <= finest && head >> 4 < roots;
    cell->level = (int32_t)(head & 15);
    cell->face = (int32_t)(head >> 4);
    for (uint32_t k = 0; k < 3; k++) {
        cell->at[k] = cage_read_number(atlas, at + 1 + k);
        sound = sound && cell->at[k] >= 0 && cell->at[k] >> cell->level == 0 && (k < (uint32_t)atlas->dim || cell->at[k] == 0);
    }
    return sound;
}

/* ---- opening -------------------------------------------------------------------------------------------- */

/* Do count entries of that size, from that place on, lie within the atlas? */
static bool fits(const cage_atlas *atlas, uint32_t place, uint32_t count, uint32_t size)
{
    return place <= (uint32_t)atlas->words && count <= ((uint32_t)atlas->words - place) / size;
}

static bool cells_are_sound(const cage_atlas *atlas)
{
    uint32_t first = cage_read_word(atlas, CAGE_ATLAS_CELL), cells = cage_read_word(atlas, CAGE_ATLAS_CELL + 1);
    uint32_t leaves = cage_read_word(atlas, CAGE_ATLAS_LEAVES);
    uint32_t roots = atlas->dim == 2 ? CAGE_ROOTS_2D : CAGE_ROOTS_3D;
    uint32_t children = atlas->dim == 2 ? CAGE_CHILDREN_2D : CAGE_CHILDREN_3D;
    uint32_t leaf = cage_read_word(atlas, CAGE_ATLAS_LEAF);
    if (!fits(atlas, first, cells, 1) || cells < roots || leaves > cells || !fits(atlas, leaf, leaves, 4))
        return false;
    for (uint32_t i = 0; i < cells; i++) {
        uint32_t entry = cage_read_word(atlas, first + i), value = entry >> 1;
        if (entry & 1 ? value >= leaves : value <= i || value > cells - children)
            return false;
    }
    for (uint32_t i = 0; i < leaves; i++) {
        struct cage_cell cell;
        if (!cage_read_cell(atlas, i, &cell))
            return false;
    }
    return true;
}

static bool side_is_sound(const cage_atlas *atlas, int32_t side)
{
    uint32_t leaves = cage_read_word(atlas, CAGE_ATLAS_LEAVES), nodes = cage_read_side(atlas, side, CAGE_SIDE_NODES);
    uint32_t classes = cage_read_side(atlas, side, CAGE_SIDE_CLASSES), edges = cage_read_side(atlas, side, CAGE_SIDE_EDGES);
    uint32_t of = cage_read_side(atlas, side, CAGE_SIDE_CLASS), row = cage_read_side(atlas, side, CAGE_SIDE_ROW);
    uint32_t to = cage_read_side(atlas, side, CAGE_SIDE_TO), leaf = cage_read_side(atlas, side, CAGE_SIDE_LEAF);
    uint32_t table = cage_read_side(atlas, side, CAGE_SIDE_TABLE);
    if (!fits(atlas, leaf, leaves, 2) || !fits(atlas, of, nodes, 1) || nodes > INT32_MAX / 2 || !fits(atlas, row, nodes + 1, 1) ||
        !fits(atlas, to, edges, 1) || !fits(atlas, table, classes, CAGE_CLASS_WORDS) || classes == 0)
        return false;
    bool sound = cage_read_word(atlas, row) == 0 && cage_read_word(atlas, row + nodes) == edges;
    for (uint32_t i = 0; i < nodes && sound; i++)
        sound = cage_read_word(atlas, of + i) < classes && cage_read_word(atlas, row + i) <= cage_read_word(atlas, row + i + 1);
    for (uint32_t i = 0; i < edges && sound; i++)
        sound = cage_read_word(atlas, to + i) < nodes;
    for (uint32_t i = 0; i < leaves && sound; i++)
        sound = fits(atlas, cage_read_word(atlas, leaf + 2 * i), CAGE_CHART_HEAD, 1) &&
                cage_read_word(atlas, leaf + 2 * i + 1) < nodes;
    return sound;
}

int32_t cage_atlas_open(cage_atlas *atlas, const void *bytes, size_t size)
{
    if (!atlas || !bytes)
        return CAGE_ERROR_ARGUMENT;
    cage_atlas made = {bytes, CAGE_ATLAS_HEAD, 0, 0, {0, 0}, {0, 0}, 0, {0, 0, 0}, {0, 0}};
    if (!cage_words_are_sealed(bytes, size, CAGE_ATLAS_MAGIC_WORD, CAGE_ATLAS_FORMAT_WORD, CAGE_ATLAS_HEAD))
        return CAGE_ERROR_ATLAS;
    made.words = (int32_t)(size / 4);
    made.dim = cage_read_number(&made, CAGE_ATLAS_DIM);
    made.side = cage_read_number(&made, CAGE_ATLAS_SIDES);
    if ((made.dim != 2 && made.dim != 3) || made.side < CAGE_SIDE_INNER || made.side > CAGE_SIDE_BOTH || !cells_are_sound(&made))
        return CAGE_ERROR_ATLAS;
    made.leaves = cage_read_number(&made, CAGE_ATLAS_LEAVES);
    for (uint32_t k = 0; k < 3; k++)
        made.pivot[k] = cage_read_length(&made, CAGE_ATLAS_PIVOT + k);
    for (int32_t side = 0; side < 2; side++) {
        if ((made.side >> side & 1) && !side_is_sound(&made, side))
            return CAGE_ERROR_ATLAS;
        made.classes[side] = (int32_t)cage_read_side(&made, side, CAGE_SIDE_CLASSES);
        made.nodes[side] = (int32_t)cage_read_side(&made, side, CAGE_SIDE_NODES);
        made.note[side] = cage_read_number(&made, (uint32_t)CAGE_ATLAS_NOTE + (uint32_t)side);
    }
    for (int32_t set = CAGE_ATLAS_OBJECT; set <= CAGE_ATLAS_OBSTACLE; set += 2)
        if (!fits(&made, cage_read_word(&made, (uint32_t)set), cage_read_word(&made, (uint32_t)set + 1), (uint32_t)made.dim + 1))
            return CAGE_ERROR_ATLAS;
    if ((uint64_t)cage_read_word(&made, CAGE_ATLAS_OBJECT + 1) * cage_read_word(&made, CAGE_ATLAS_OBSTACLE + 1) >
        CAGE_PAIRS_MAX)
        return CAGE_ERROR_ATLAS;
    *atlas = made;
    return CAGE_OK;
}

/* ---- a list ---------------------------------------------------------------------------------------------- */

/* Does the closed simplex with these vertices hold the point? */
static bool holds(const cage_atlas *atlas, uint32_t chart, uint32_t vertex, const int32_t p[3])
{
    int32_t from[4][3]; /* the point to its vertices */
    for (uint32_t k = 0; k <= (uint32_t)atlas->dim; k++) {
        const cage_ball ball = cage_read_ball(atlas, chart + cage_read_word(atlas, vertex + k));
        from[k][0] = ball.x - p[0];
        from[k][1] = ball.y - p[1];
        from[k][2] = ball.z - p[2];
    }
    for (int32_t i = 0; i <= atlas->dim; i++) {
        const int32_t *face = atlas->dim == 2 ? CAGE_FACE_2D[i] : CAGE_FACE_3D[i];
        if (cage_side_from(atlas->dim, from[face[0]], from[face[1]], from[face[atlas->dim == 2 ? 1 : 2]]) < 0)
            return false;
    }
    return true;
}

int32_t cage_read_list(const cage_atlas *atlas, uint32_t chart, uint32_t list, const int32_t p[3])
{
    uint32_t balls = cage_read_word(atlas, list) & 65535, simplices = cage_read_word(atlas, list) >> 16, next = list + 2 + balls;
    for (uint32_t i = 0; i < balls; i++) {
        const cage_ball ball = cage_read_ball(atlas, chart + cage_read_word(atlas, list + 2 + i));
        const struct cage_site site = {0, ball.x, ball.y, ball.z, ball.r};
        if (cage_power(&site, p) <= 0)
            return CAGE_COVERED;
    }
    for (uint32_t i = 0; i < simplices; i++, next += (uint32_t)atlas->dim + 2)
        if (holds(atlas, chart, next + 1, p))
            return cage_read_number(atlas, next);
    return cage_read_number(atlas, list + 1);
}

