/* read: the words of an atlas, wherever they lie and whatever they are. */
#ifndef CAGE_READ_H
#define CAGE_READ_H

#include "atlas.h"
#include "fibre.h"
#include "words.h"

/* Any place may be asked for: beyond the end all words are 0. */
static CAGE_INLINE uint32_t cage_read_word(const cage_atlas *atlas, uint32_t at)
{
    return at < (uint32_t)atlas->words ? cage_words_get(atlas->byte, at) : 0;
}

static CAGE_INLINE int32_t cage_read_number(const cage_atlas *atlas, uint32_t at)
{
    return cage_words_number(cage_read_word(atlas, at));
}

/* A word of the side's table: CAGE_SIDE_... */
static CAGE_INLINE uint32_t cage_read_side(const cage_atlas *atlas, int32_t side, uint32_t at)
{
    return cage_read_word(atlas, CAGE_ATLAS_SIDE + (uint32_t)side * CAGE_SIDE_WORDS + at);
}

/* A coordinate or a radius: whatever the bytes are, within what the scene's dimension allows. */
int32_t cage_read_length(const cage_atlas *atlas, uint32_t at);

/* A ball: its centre and its radius, as many words as the atlas has dimensions and one. */
cage_ball cage_read_ball(const cage_atlas *atlas, uint32_t at);

/* The cell of a leaf; false: the bytes are none. */
bool cage_read_cell(const cage_atlas *atlas, uint32_t leaf, struct cage_cell *cell);

/* Does a closed ball of the list at that word of the chart (see chart.h) hold the grid point? The component if none does. */
int32_t cage_read_list(const cage_atlas *atlas, uint32_t chart, uint32_t list, const int32_t p[3]);

/* The cells of its dimension; questions go without, so that an image which only asks does not carry it. */
static CAGE_INLINE const struct cage_fibre *cage_read_fibre(const cage_atlas *atlas)
{
    return atlas->dim == 2 ? &cage_so2 : &cage_so3;
}

#endif
