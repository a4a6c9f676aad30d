// The mean of a column over the members of a scene: example SCENE COLUMN
#include <cstdio>
#include <numeric>

#include <slideway/slideway.hpp>

int main(int argc, char** argv) try {
    if (argc != 3) return std::fputs("usage: example SCENE COLUMN\n", stderr), 2;
    slideway::Result const result = slideway::Ensemble::read(argv[1]).run();
    auto const column = result.column(argv[2]);
    auto const values = column.numbers();
    std::printf("%.17g\n", std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()));
} catch (slideway::Error const& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.code();
}
