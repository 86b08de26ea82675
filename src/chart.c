/* chart: a tree of boxes that tells which component of a slice a grid point lies in.
 *
 * In a box a ball matters only if it meets the box, and somewhere in it is nearer, in power, than the one nearest to its middle:
 * else that one covers there what it covers. A point off those that matter is off every ball and lies in a free simplex, which
 * tells its component (location lemma). When few balls matter, and few free simplices but for those of one component meet
 * the box, they are listed. Else the box is halved along each axis; a box of one point always ends it. */
#include "chart.h"
#include "box.h"

#include <string.h>

enum { LEVELS = 31, NO_WORD = -1, PHANTOM = -2, HASHES = 1024 };
enum { LONGEST = 2 + CAGE_CHART_BALLS_3D + 5 * CAGE_CHART_SIMPLICES };

/* What becomes of a box without an entry. */
enum { HALVE = -1, NO_ROOM = -2 };

/* A box that was halved. */
struct frame {
    int32_t low[3];
    int32_t bits;  /* of its size */
    int32_t entry; /* where its halves' entries begin */
    int32_t left;  /* halves to do */
    const int32_t *site; /* those that matter */
    int32_t sites;
    const int32_t *open; /* free simplices near it, as numbers of their bounds */
    int32_t opens;
};

/* A free simplex, a box around what may be free in it, its component or PHANTOM. */
struct bounds {
    int32_t low[3], high[3];
    int32_t simplex;
    int32_t label;
};

struct draft {
    const struct cage_slice *slice;
    const struct cage_triangulation *t;
    int32_t low[3], high[3]; /* the bounding box */
    uint32_t *word;
    int32_t words, room;
    int32_t *home;  /* of each site: the word where it is, or NO_WORD */
    int32_t *list;  /* LEVELS lists of sites */
    struct bounds *opening; /* all free simplices */
    int32_t openings;
    int32_t *open; /* LEVELS lists of them */
    int32_t *met;  /* those that meet the last box */
    int32_t near;  /* a simplex near the last box */
    int32_t known[HASHES]; /* words where lists begin, by a hash; 0: none */
    uint32_t making[LONGEST];
};

/* So many words more, or NO_WORD. */
static int32_t add_words(struct draft *draft, int32_t count)
{
    if (draft->words > draft->room - count)
        return NO_WORD;
    draft->words += count;
    return draft->words - count;
}

/* ---- which free simplices meet a box ------------------------------------------------------------------------ */

/* Is the box beyond one facet? If not they may meet. */
static bool is_beyond(const struct draft *draft, int32_t s, const struct cage_box *box)
{
    const struct cage_triangulation *t = draft->t;
    for (int32_t i = 0; i <= t->dim; i++) {
        const struct cage_site *facet[3];
        int32_t b[3], c[3] = {0, 0, 1};
        int64_t normal[3]; /* toward the simplex */
        cage_facet_sites(t, s, i, facet);
        cage_difference(facet[1], facet[0], b);
        if (t->dim == 3)
            cage_difference(facet[2], facet[0], c);
        normal[0] = cage_minor(b[1], c[2], b[2], c[1]);
        normal[1] = cage_minor(b[2], c[0], b[0], c[2]);
        normal[2] = cage_minor(b[0], c[1], b[1], c[0]);
        for (int32_t k = 0; k < 3 && t->dim == 2; k++)
            normal[k] = -normal[k];
        const struct cage_site corner = {0, (int32_t)(normal[0] > 0 ? box->high : box->low)[0],
                                         (int32_t)(normal[1] > 0 ? box->high : box->low)[1],
                                         (int32_t)(normal[2] > 0 ? box->high : box->low)[2], 0};
        if (cage_side(t->dim, facet, &corner) < 0)
            return true;
    }
    return false;
}

static CAGE_INLINE void widen(struct bounds *bounds, int32_t k, int32_t at, bool first)
{
    bounds->low[k] = first || at < bounds->low[k] ? at : bounds->low[k];
    bounds->high[k] = first || at > bounds->high[k] ? at : bounds->high[k];
}

static void cut_to_ball(struct bounds *bounds, const struct cage_orthoball *ball)
{
    for (int32_t k = 0; k < 3; k++) { /* < 2^30 + 2^28; in the plane 0 is within */
        int32_t low = ball->at[k] - ball->radius, high = ball->at[k] + ball->radius;
        bounds->low[k] = low > bounds->low[k] ? low : bounds->low[k];
        bounds->high[k] = high < bounds->high[k] ? high : bounds->high[k];
    }
}

/* One more that is free; ball: its orthoball, null where it is of no bounded component. */
static void open(struct draft *draft, int32_t s, int32_t label, const struct cage_orthoball *ball)
{
    struct bounds made = {{0, 0, 0}, {0, 0, 0}, s, label};
    for (int32_t i = 0; i <= draft->t->dim; i++) {
        const struct cage_site *site = &draft->t->site[draft->t->simplex[s].v[i]];
        widen(&made, 0, site->x, i == 0);
        widen(&made, 1, site->y, i == 0);
        widen(&made, 2, site->z, i == 0);
    }
    if (ball)
        cut_to_ball(&made, ball);
    draft->open[draft->openings] = draft->openings;
    draft->opening[draft->openings++] = made;
}

/* All free simplices. One may be free as far as the balls triangulated go, and covered by one that was left out (see prune.h). */
static void find_free(struct draft *draft)
{
    const struct cage_triangulation *t = draft->t;
    const struct cage_slice *slice = draft->slice;
    for (int32_t i = 0; i < slice->orthoballs; i++)
        open(draft, slice->orthoball[i].simplex, slice->label[slice->orthoball[i].simplex], &slice->orthoball[i]);
    for (int32_t s = 0; s < t->simplices; s++)
        if (slice->label[s] == CAGE_OUTSIDE || (slice->label[s] == CAGE_COVERED && !slice->whole && cage_component_free(t, s)))
            open(draft, s, slice->label[s] == CAGE_OUTSIDE ? CAGE_OUTSIDE : PHANTOM, NULL);
}

/* Those of them whose bounds meet the box. */
static int32_t nearby(const struct draft *draft, const struct cage_box *box, const int32_t *from, int32_t count, int32_t *to)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < count; i++) {
        const struct bounds *b = &draft->opening[from[i]];
        to[kept] = from[i]; /* stays if they meet: a branch would be a coin toss */
        kept += (b->low[0] <= box->high[0]) & (b->high[0] >= box->low[0]) & (b->low[1] <= box->high[1]) &
                (b->high[1] >= box->low[1]) & (b->low[2] <= box->high[2]) & (b->high[2] >= box->low[2]);
    }
    return kept;
}

/* The label that most of them have (more than half, if there is one such). */
static int32_t usual(const struct draft *draft, const int32_t *open, int32_t opens)
{
    int32_t best = CAGE_COVERED, votes = 0;
    for (int32_t i = 0; i < opens; i++) {
        int32_t label = draft->opening[open[i]].label;
        votes += label == best ? 1 : -1; /* Boyer, Moore, "MJRTY", 1991 */
        if (votes < 0) {
            best = label;
            votes = 1;
        }
    }
    return best;
}

/* Does one of that label meet the box? */
static bool has_met(const struct draft *draft, const struct cage_box *box, const int32_t *open, int32_t opens, int32_t label)
{
    bool met = false;
    for (int32_t i = 0; i < opens && !met; i++)
        met = draft->opening[open[i]].label == label && !is_beyond(draft, draft->opening[open[i]].simplex, box);
    return met;
}

/* The label of what is free in the box and in none of draft->met, all those of other labels that meet the box; *met: their
 * number. It is the outside if that is met, as it alone has simplices with a sentinel. */
static int32_t meet(struct draft *draft, const struct cage_box *box, const int32_t *open, int32_t opens, int32_t *met)
{
    int32_t label = usual(draft, open, opens);
    bool differ = false;
    *met = 0;
    for (int32_t i = 0; i < opens; i++)
        differ = differ || draft->opening[open[i]].label != label;
    if (!differ)
        return label;
    if (label != CAGE_OUTSIDE && has_met(draft, box, open, opens, CAGE_OUTSIDE))
        label = CAGE_OUTSIDE;
    for (int32_t i = 0; i < opens; i++)
        if (draft->opening[open[i]].label != label && !is_beyond(draft, draft->opening[open[i]].simplex, box))
            draft->met[(*met)++] = open[i];
    if (has_met(draft, box, open, opens, label))
        return label;
    label = usual(draft, draft->met, *met);
    opens = *met;
    *met = 0;
    for (int32_t i = 0; i < opens; i++)
        if (draft->opening[draft->met[i]].label != label)
            draft->met[(*met)++] = draft->met[i];
    return label;
}

/* ---- which balls matter in a box ------------------------------------------------------------------------ */

/* Is a as near in power as b, or nearer, all over the box? |z|^2 - r^2 < 2^59.1, differences of centres < 2^29, corners
 * < 2^28: < 2^61. */
static bool is_nearer(const struct cage_site *a, const struct cage_site *b, const struct cage_box *box)
{
    int64_t least = b->h - a->h;
    int32_t d[3];
    cage_difference(b, a, d);
    for (int32_t k = 0; k < 3; k++)
        least -= 2 * (int64_t)d[k] * (d[k] > 0 ? box->high[k] : box->low[k]);
    return least >= 0;
}

/* Those of the sites that matter; -1: one of them holds the box. */
static int32_t choose(const struct draft *draft, const struct cage_box *box, const int32_t *from, int32_t count, int32_t *to)
{
    const struct cage_site *site = draft->t->site, *best = NULL;
    const int32_t middle[3] = {(int32_t)((box->low[0] + box->high[0]) / 2), (int32_t)((box->low[1] + box->high[1]) / 2),
                               (int32_t)((box->low[2] + box->high[2]) / 2)};
    int32_t met = 0, kept = 0;
    int64_t least = INT64_MAX;
    for (int32_t i = 0; i < count; i++) {
        if (!cage_box_meets(box, &site[from[i]]))
            continue;
        int64_t power = cage_power(&site[from[i]], middle);
        to[met++] = from[i];
        if (power < least) {
            least = power;
            best = &site[from[i]];
        }
    }
    if (best && cage_box_is_held(box, best))
        return -1;
    for (int32_t i = 0; i < met; i++)
        if (&site[to[i]] == best || !is_nearer(best, &site[to[i]], box))
            to[kept++] = to[i];
    return kept;
}

/* ---- writing -------------------------------------------------------------------------------------------- */

static uint32_t entry_of(uint32_t kind, int32_t value) { return (uint32_t)value << 2 | kind; }

/* The word where the ball is. */
static int32_t ball_word(struct draft *draft, int32_t site)
{
    const struct cage_site *ball = &draft->t->site[site];
    int32_t dim = draft->t->dim, at = draft->home[site];
    if (at != NO_WORD || (at = add_words(draft, dim + 1)) == NO_WORD)
        return at;
    draft->home[site] = at;
    draft->word[at] = (uint32_t)ball->x;
    draft->word[at + 1] = (uint32_t)ball->y;
    if (dim == 3)
        draft->word[at + 2] = (uint32_t)ball->z;
    draft->word[at + dim] = (uint32_t)ball->r;
    return at;
}

/* The word where the list is, written unless one like it was; NO_WORD: no room. */
static int32_t list_word(struct draft *draft, const uint32_t *list, int32_t length)
{
    uint32_t hash = 2166136261u; /* FNV-1a */
    for (int32_t i = 0; i < length; i++)
        hash = (hash ^ list[i]) * 16777619u;
    int32_t *known = &draft->known[(hash ^ hash >> 16) % HASHES];
    size_t bytes = (size_t)length * sizeof *list;
    if (*known && *known + length <= draft->words && memcmp(&draft->word[*known], list, bytes) == 0)
        return *known;
    int32_t at = add_words(draft, length);
    if (at != NO_WORD) {
        memcpy(&draft->word[at], list, bytes);
        *known = at;
    }
    return at;
}

/* The entry of a box in which these balls matter, and the simplices met that are not of the label; or HALVE, or NO_ROOM. */
static int64_t list_entry(struct draft *draft, const int32_t *site, int32_t balls, int32_t label, int32_t met)
{
    uint32_t *list = draft->making;
    int32_t length = 2;
    if (met > CAGE_CHART_SIMPLICES)
        return HALVE;
    if (label == PHANTOM)
        label = CAGE_COVERED;
    if (label == CAGE_COVERED && met == 0)
        return entry_of(CAGE_CHART_LABEL, 0);
    for (int32_t i = 0; i < balls; i++) {
        int32_t at = ball_word(draft, site[i]);
        if (at == NO_WORD)
            return NO_ROOM;
        list[length++] = (uint32_t)at;
    }
    for (int32_t i = 0; i < met; i++) {
        int32_t s = draft->opening[draft->met[i]].simplex, other = draft->opening[draft->met[i]].label;
        list[length++] = (uint32_t)(other == PHANTOM ? CAGE_COVERED : other);
        for (int32_t k = 0; k <= draft->t->dim; k++) {
            int32_t at = ball_word(draft, draft->t->simplex[s].v[k]);
            if (at == NO_WORD)
                return NO_ROOM;
            list[length++] = (uint32_t)at;
        }
    }
    list[0] = (uint32_t)met << 16 | (uint32_t)balls;
    list[1] = (uint32_t)label;
    int32_t at = list_word(draft, list, length);
    return at == NO_WORD ? NO_ROOM : (int64_t)entry_of(CAGE_CHART_LIST, at);
}

/* ---- the tree ------------------------------------------------------------------------------------------- */

/* The box of a frame's half, clipped to the bounding box; false: nothing is left of it. */
static bool half_of(const struct draft *draft, const struct frame *frame, int32_t half, struct cage_box *box)
{
    int64_t size = (int64_t)1 << (frame->bits - 1);
    for (int32_t k = 0; k < 3; k++) {
        int64_t low = frame->low[k] + (half >> k & 1 ? size : 0), high = low + size - 1;
        box->low[k] = k < draft->t->dim ? low : 0;
        box->high[k] = k >= draft->t->dim ? 0 : high < draft->high[k] ? high : draft->high[k];
        if (box->low[k] > box->high[k])
            return false;
    }
    return true;
}

/* The entry of a box in which these sites matter, or HALVE, or NO_ROOM. */
static int64_t settle(struct draft *draft, const struct cage_box *box, const int32_t *site, int32_t count, const int32_t *open,
                      int32_t opens)
{
    int32_t most = draft->t->dim == 2 ? CAGE_CHART_BALLS_2D : CAGE_CHART_BALLS_3D;
    const int32_t point[3] = {(int32_t)box->low[0], (int32_t)box->low[1], (int32_t)box->low[2]};
    if (count == 0) {
        draft->near = cage_delaunay_locate(draft->t, point, draft->near);
        return entry_of(CAGE_CHART_LABEL, 1 + draft->slice->label[draft->near]);
    }
    if (box->low[0] == box->high[0] && box->low[1] == box->high[1] && box->low[2] == box->high[2])
        return entry_of(CAGE_CHART_LABEL, 1 + cage_slice_locate(draft->slice, point));
    if (count > most)
        return HALVE;
    int32_t met, label = meet(draft, box, open, opens, &met);
    return list_entry(draft, site, count, label, met);
}

/* Write the entries of all halves below the frame, depth first. False: no room. */
static bool grow(struct draft *draft, const struct frame *top)
{
    struct frame frame[LEVELS] = {*top};
    int32_t depth = 0;
    while (depth >= 0) {
        struct frame *f = &frame[depth];
        struct cage_box box;
        if (f->left == 0) {
            depth--;
            continue;
        }
        int32_t half = --f->left, *site = draft->list + (size_t)(depth + 1) * (size_t)draft->t->sites;
        int32_t *open = draft->open + (size_t)(depth + 1) * (size_t)draft->t->simplices;
        draft->word[f->entry + half] = entry_of(CAGE_CHART_LABEL, 0); /* covered; beyond the bounding box nothing is asked */
        if (!half_of(draft, f, half, &box))
            continue;
        int32_t count = choose(draft, &box, f->site, f->sites, site), at = NO_WORD;
        if (count < 0)
            continue;
        int32_t opens = nearby(draft, &box, f->open, f->opens, open);
        if (opens == 0)
            continue;
        int64_t entry = settle(draft, &box, site, count, open, opens);
        if (entry == HALVE && (at = add_words(draft, 1 << draft->t->dim)) != NO_WORD) {
            const struct frame next = {{(int32_t)box.low[0], (int32_t)box.low[1], (int32_t)box.low[2]},
                                       f->bits - 1, at, 1 << draft->t->dim, site, count, open, opens};
            frame[++depth] = next; /* sizes of at least 2: fewer than LEVELS */
            entry = entry_of(CAGE_CHART_SPLIT, at);
        }
        if (entry < 0)
            return false;
        draft->word[f->entry + half] = (uint32_t)entry;
    }
    return true;
}

static void bound(struct draft *draft)
{
    for (int32_t k = 0; k < 3; k++) {
        draft->low[k] = 0;
        draft->high[k] = draft->t->sites > draft->t->dim + 1 ? 0 : -1;
    }
    for (int32_t i = draft->t->dim + 1; i < draft->t->sites; i++) {
        const struct cage_site *ball = &draft->t->site[i];
        const int32_t at[3] = {ball->x, ball->y, ball->z};
        for (int32_t k = 0; k < draft->t->dim; k++) {
            bool first = i == draft->t->dim + 1;
            draft->low[k] = first || at[k] - ball->r < draft->low[k] ? at[k] - ball->r : draft->low[k];
            draft->high[k] = first || at[k] + ball->r > draft->high[k] ? at[k] + ball->r : draft->high[k];
        }
    }
}

/* All words; false: no room. */
static bool write(struct draft *draft)
{
    int32_t count = 0, bits = 0;
    if (add_words(draft, CAGE_CHART_HEAD) == NO_WORD)
        return false;
    for (int32_t k = 0; k < 3; k++) {
        while (((int64_t)1 << bits) <= (int64_t)draft->high[k] - draft->low[k])
            bits++; /* <= 29 */
        draft->word[CAGE_CHART_LOW + k] = (uint32_t)draft->low[k];
        draft->word[CAGE_CHART_HIGH + k] = (uint32_t)draft->high[k];
    }
    draft->word[CAGE_CHART_BITS] = (uint32_t)bits;
    for (int32_t i = draft->t->dim + 1; i < draft->t->sites; i++)
        draft->list[count++] = i;
    /* The root is the low half of a box twice as large, of which nothing else is done. */
    const struct frame top = {{draft->low[0], draft->low[1], draft->low[2]}, bits + 1, CAGE_CHART_ROOT, 1, draft->list, count,
                              draft->open, draft->openings};
    return grow(draft, &top);
}

int32_t cage_chart_make(struct cage_arena *arena, const struct cage_slice *slice, struct cage_chart *out)
{
    size_t mark = arena->used, sites = (size_t)slice->t.sites, simplices = (size_t)slice->t.simplices;
    struct draft *draft = cage_arena_take(arena, 1, sizeof *draft);
    if (!draft)
        return CAGE_ERROR_MEMORY;
    memset(draft, 0, sizeof *draft);
    draft->slice = slice;
    draft->t = &slice->t;
    draft->home = cage_arena_take(arena, sites, sizeof *draft->home);
    draft->list = cage_arena_take(arena, sites * LEVELS, sizeof *draft->list);
    draft->opening = cage_arena_take(arena, simplices, sizeof *draft->opening);
    draft->open = cage_arena_take(arena, simplices * LEVELS, sizeof *draft->open);
    draft->met = cage_arena_take(arena, simplices, sizeof *draft->met);
    size_t room = cage_arena_room(arena, sizeof *draft->word), before = arena->used, peak = arena->peak;
    draft->room = room > 1 << 29 ? 1 << 29 : (int32_t)room;
    draft->word = cage_arena_take(arena, (size_t)draft->room, sizeof *draft->word);
    uint32_t *word = draft->word;
    bool done = draft->home && draft->list && draft->opening && draft->open && draft->met && word;
    if (done) {
        memset(draft->home, -1, sites * sizeof *draft->home);
        find_free(draft);
        bound(draft);
        done = write(draft);
    }
    out->words = draft->words;
    size_t most = before + 4 * (size_t)out->words; /* words not used do not count */
    arena->peak = most > peak ? most : peak;
    cage_arena_release(arena, mark);
    if (!done) {
        arena->needed = 2 * arena->size + 4096;
        return CAGE_ERROR_MEMORY;
    }
    out->word = cage_arena_take(arena, (size_t)out->words, sizeof *out->word);
    memmove(out->word, word, (size_t)out->words * sizeof *word);
    return CAGE_OK;
}
