#include "host/chaos/delay_embedding.hpp"

#include <cmath>

#include <nanoflann.hpp>

namespace slideway {
namespace {

/// The embedding in the words of nanoflann.
struct Points {
    DelayEmbedding const& embedding;
    std::size_t count;

    std::size_t kdtree_get_point_count() const { return count; }
    double kdtree_get_pt(std::size_t point, std::size_t coordinate) const { return embedding(point, coordinate); }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, -1, std::size_t>;

/// Keeps the one nearest point that counts as a neighbour; the tree skips whatever lies beyond it.
class NearestOutsideWindow {
public:
    NearestOutsideWindow(std::size_t self, std::size_t theiler, double resolution)
        : self_(self), theiler_(theiler), least_(resolution * resolution) {}

    // NOLINTNEXTLINE(readability-identifier-naming): the tree calls it so
    bool addPoint(double squared, std::size_t index) {
        std::size_t const apart = index > self_ ? index - self_ : self_ - index;
        if (apart <= theiler_ || !(squared > least_)) return true;
        // The order in which the tree finds points shall not show.
        if (squared < squared_ || (squared == squared_ && index < index_)) {
            squared_ = squared;
            index_ = index;
        }
        return true;
    }
    // The tree asks for less than this; equally near ones shall come too.
    // NOLINTNEXTLINE(readability-identifier-naming): the tree calls it so
    double worstDist() const { return std::nextafter(squared_, std::numeric_limits<double>::infinity()); }
    bool full() const { return index_ != Neighbour::none; }
    std::size_t size() const { return full() ? 1 : 0; }
    Neighbour result() const { return full() ? Neighbour{index_, std::sqrt(squared_)} : Neighbour{}; }

private:
    std::size_t self_, theiler_;
    double least_;
    std::size_t index_ = Neighbour::none;
    double squared_ = std::numeric_limits<double>::max();
};

}  // namespace

std::vector<Neighbour> nearest_neighbours(DelayEmbedding const& embedding, std::size_t points, std::size_t theiler,
                                          double resolution) {
    points = std::min(points, embedding.size());
    std::vector<Neighbour> neighbours(points);
    if (points < 2) return neighbours;
    Points const adaptor{embedding, points};
    Tree const tree(static_cast<int>(embedding.dimension()), adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    std::vector<double> query(embedding.dimension());
    for (std::size_t i = 0; i < points; ++i) {
        for (std::size_t k = 0; k < query.size(); ++k) query[k] = embedding(i, k);
        NearestOutsideWindow nearest(i, theiler, resolution);
        tree.findNeighbors(nearest, query.data(), nanoflann::SearchParams());
        neighbours[i] = nearest.result();
    }
    return neighbours;
}

}  // namespace slideway
