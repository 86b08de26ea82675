/* metric_none.c: what stands for metric.c in a build without CHOLMOD. */
#include "smooth.h"

int smooth_metric_available(void)
{
    return 0;
}

const char *smooth_metric_name(void)
{
    return "none";
}

smooth_metric *smooth_metric_make(int stations, double stiffness)
{
    (void)stations;
    (void)stiffness;
    return NULL;
}

void smooth_metric_free(smooth_metric *metric)
{
    (void)metric;
}

int smooth_metric_solve(smooth_metric *metric, const double *in, double *out, int columns)
{
    (void)metric;
    (void)in;
    (void)out;
    (void)columns;
    return -1;
}
