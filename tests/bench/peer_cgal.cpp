// peer_cgal.cpp: CGAL's regular triangulations on the sets of the benchmark: `peer_cgal SET [RUNS]` prints one line.
#include "sets.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
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

int main(int argc, char **argv)
{
    bench_set set;
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
