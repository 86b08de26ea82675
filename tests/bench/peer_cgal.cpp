// peer_cgal.cpp: CGAL's regular triangulations on the sets of the benchmark: `peer_cgal SET [RUNS]` prints one line,
// `peer_cgal slices FILE` one for each slice.
#include "sets.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Plane {
    using Triangulation = CGAL::Regular_triangulation_2<Kernel>;
    using Point = Kernel::Weighted_point_2;
    static Point point(const int32_t *b) { return Point(Kernel::Point_2(b[0], b[1]), double(b[3]) * b[3]); }
    static size_t simplices(const Triangulation &t) { return t.number_of_faces(); }
};

struct Space {
    using Triangulation = CGAL::Regular_triangulation_3<Kernel>;
    using Point = Kernel::Weighted_point_3;
    static Point point(const int32_t *b) { return Point(Kernel::Point_3(b[0], b[1], b[2]), double(b[3]) * b[3]); }
    static size_t simplices(const Triangulation &t) { return t.number_of_finite_cells(); }
};

template <class World> static void run(const bench_set &set, int runs)
{
    std::vector<typename World::Point> points;
    for (int32_t i = 0; i < set.count; i++)
        points.push_back(World::point(set.ball + 4 * size_t(i)));
    std::vector<double> ns;
    size_t simplices = 0, vertices = 0;
    for (int i = 0; i < runs; i++) {
        auto copy = points; // CGAL sorts along its own curve, as it does for every user
        auto start = std::chrono::steady_clock::now();
        typename World::Triangulation t(copy.begin(), copy.end());
        auto end = std::chrono::steady_clock::now();
        ns.push_back(std::chrono::duration<double, std::nano>(end - start).count() / set.count);
        simplices = World::simplices(t);
        vertices = t.number_of_vertices();
    }
    std::sort(ns.begin(), ns.end());
    std::printf("%s %d %d %.1f %.1f %zu %zu\n", set.name, set.dim, set.count, ns[0], ns[ns.size() / 2], simplices, vertices);
}

// Seconds of processor time.
static double processor()
{
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// Slices that the benchmark of slices in space has written, each a count and its balls: a line for each, balls and ns.
static int run_slices(const char *name)
{
    std::FILE *file = std::fopen(name, "rb");
    bool counted = false; // the first time is not
    int32_t count;
    if (!file)
        return 2;
    while (std::fread(&count, sizeof count, 1, file) == 1) {
        std::vector<int32_t> ball(size_t(count) * 4);
        if (std::fread(ball.data(), 4 * sizeof(int32_t), size_t(count), file) != size_t(count))
            return 2;
        std::vector<Space::Point> points;
        for (int32_t i = 0; i < count; i++)
            points.push_back(Space::point(&ball[4 * size_t(i)]));
        for (int i = counted ? 1 : 0; i < 2; i++) {
            auto copy = points;
            double start = processor();
            Space::Triangulation t(copy.begin(), copy.end());
            double taken = processor() - start;
            if (i == 1)
                std::printf("%d %.0f %zu\n", count, 1e9 * taken, t.number_of_vertices());
        }
        counted = true;
    }
    std::fclose(file);
    return 0;
}

int main(int argc, char **argv)
{
    bench_set set;
    if (argc > 2 && !std::strcmp(argv[1], "slices"))
        return run_slices(argv[2]);
    int number = argc > 1 ? std::atoi(argv[1]) : -1;
    if (number < 0 || number >= BENCH_SETS) {
        std::fprintf(stderr, "usage: peer_cgal SET [RUNS], SET in 0..%d\n", BENCH_SETS - 1);
        return 2;
    }
    bench_set_make(&set, number);
    int runs = argc > 2 ? std::atoi(argv[2]) : bench_runs(&set);
    if (set.dim == 2)
        run<Plane>(set, runs);
    else
        run<Space>(set, runs);
    std::free(set.ball);
}
