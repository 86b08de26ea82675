/* oracle_space_tree.h: random trees of moves that are certified free: a proof that a path exists. */
#ifndef ORACLE_SPACE_TREE_H
#define ORACLE_SPACE_TREE_H

#include "oracle_space.h"

/* 1: a path was found, out or to the goal, each of its moves straight or a turn about the pivot, free (outer balls) with
 * ORACLE_SLACK to spare; 0: not found in so many tries. The same tries each time. */
int space_tree_joins(const space_question *q, int tries, space_audit *audit);

#endif
