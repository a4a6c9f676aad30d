// Dimensions of a result file with a label for each entry.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/store/netcdf_file.hpp"

namespace slideway {

/// Defines the dimensions of the quantity table (apex, mode_class, axis, direction, channel) as they are asked for, each with its labels in
/// `<name>_name`.
class LabelAxes {
public:
    explicit LabelAxes(NetcdfFile& file) : file_(file) {}
    struct Axis {
        int dimension;
        std::string label_name;
    };
    /// Before the end of definitions.
    Axis const& axis(std::string const& name);
    /// The labels; after it.
    void write() const;

private:
    struct LabelVariable {
        int id;
        std::vector<std::string> labels;
    };
    NetcdfFile& file_;
    std::map<std::string, Axis> axes_;
    std::vector<LabelVariable> labels_;
    int label_dimension_ = -1;
};

}  // namespace slideway
