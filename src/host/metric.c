/* metric.c: the smoothness metric A = K'K of a path, factored once by CHOLMOD. */
#include <stdlib.h>

#include <cholmod.h>

#include "smooth.h"

struct smooth_metric {
    cholmod_common common;
    cholmod_factor *factor;
    int stations;
};

int smooth_metric_available(void)
{
    return 1;
}

const char *smooth_metric_name(void)
{
    return "CHOLMOD";
}

static void put(cholmod_triplet *t, int station, int difference, double value, int stations)
{
    if (station < 0 || station >= stations) /* an end: fixed */
        return;
    ((int *)t->i)[t->nnz] = station;
    ((int *)t->j)[t->nnz] = difference;
    ((double *)t->x)[t->nnz++] = value;
}

/* K' by its entries, one column for each difference. */
static cholmod_triplet *differences(int stations, double stiffness, cholmod_common *common)
{
    const size_t n = (size_t)stations;
    cholmod_triplet *t = cholmod_allocate_triplet(n, 2 * n + 1, 5 * n + 2, 0, CHOLMOD_REAL, common);
    int k;

    if (t == NULL)
        return NULL;
    for (k = 0; k <= stations; k++) {
        put(t, k - 1, k, -1, stations);
        put(t, k, k, 1, stations);
    }
    for (k = 0; k < stations; k++) {
        put(t, k - 1, stations + 1 + k, stiffness, stations);
        put(t, k, stations + 1 + k, -2 * stiffness, stations);
        put(t, k + 1, stations + 1 + k, stiffness, stations);
    }
    return t;
}

smooth_metric *smooth_metric_make(int stations, double stiffness)
{
    smooth_metric *metric = calloc(1, sizeof *metric);
    cholmod_triplet *triplet;
    cholmod_sparse *sparse = NULL;
    int fine = 0;

    if (metric == NULL)
        return NULL;
    metric->stations = stations;
    if (!cholmod_start(&metric->common)) {
        free(metric);
        return NULL;
    }
    metric->common.print = 0;
    triplet = differences(stations, stiffness, &metric->common);
    if (triplet != NULL)
        sparse = cholmod_triplet_to_sparse(triplet, triplet->nnz, &metric->common);
    if (sparse != NULL) /* a matrix that is not symmetric is factored times its transpose */
        metric->factor = cholmod_analyze(sparse, &metric->common);
    if (metric->factor != NULL)
        fine = cholmod_factorize(sparse, metric->factor, &metric->common) && metric->common.status == CHOLMOD_OK;
    (void)cholmod_free_triplet(&triplet, &metric->common);
    (void)cholmod_free_sparse(&sparse, &metric->common);
    if (!fine) {
        smooth_metric_free(metric);
        return NULL;
    }
    return metric;
}

void smooth_metric_free(smooth_metric *metric)
{
    if (metric == NULL)
        return;
    (void)cholmod_free_factor(&metric->factor, &metric->common);
    (void)cholmod_finish(&metric->common);
    free(metric);
}

int smooth_metric_solve(smooth_metric *metric, const double *in, double *out, int columns)
{
    const size_t n = (size_t)metric->stations, count = n * (size_t)columns;
    cholmod_dense *right = cholmod_allocate_dense(n, (size_t)columns, n, CHOLMOD_REAL, &metric->common), *solved;
    size_t i;

    if (right == NULL)
        return -1;
    for (i = 0; i < count; i++)
        ((double *)right->x)[i] = in[i];
    solved = cholmod_solve(CHOLMOD_A, metric->factor, right, &metric->common);
    for (i = 0; solved != NULL && i < count; i++)
        out[i] = ((const double *)solved->x)[i];
    i = solved != NULL && metric->common.status == CHOLMOD_OK;
    (void)cholmod_free_dense(&right, &metric->common);
    (void)cholmod_free_dense(&solved, &metric->common);
    return i ? 0 : -1;
}
