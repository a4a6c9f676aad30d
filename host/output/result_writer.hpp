// Writes a result file (NetCDF-4, CF-1.8).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/driver/block_result.hpp"
#include "host/driver/stop.hpp"
#include "host/output/netcdf_file.hpp"
#include "host/output/provenance.hpp"
#include "host/output/result_layout.hpp"
#include "host/output/section_writer.hpp"
#include "host/output/study_columns.hpp"

namespace slideway {

/// Writes to `path`.part and renames it at the end, so that no half file looks whole and a former file at `path`
/// stays until the new one is complete.  Members that are never written have status not_run and NaN elsewhere.
class ResultWriter {
public:
    /// Creates the file and its header, so that a folder without write permission or room is found before any work.
    /// @throws FileError, also if the members do not fit the file's 32-bit member numbers.
    ResultWriter(std::string path, ResultLayout layout, Provenance const& provenance);
    /// Removes the file if `finish` was not reached.
    ~ResultWriter();
    ResultWriter(ResultWriter const&) = delete;
    ResultWriter& operator=(ResultWriter const&) = delete;

    /// Blocks in any order; the file is the same.  @param study the study's columns of these members  @throws FileError.
    void write(BlockResult const& block, StudyValues const& study = {});

    /// Hashes, closes and renames.  @throws FileError; if only the renaming failed, the file stays as `path`.part.
    void finish(double lane_utilisation, StopReason stopped);

private:
    struct QuantityVariable {
        int id;
        int first_column, columns;
    };
    void define_coordinates();
    void define_members();
    void define_quantities();
    void define_series();
    void describe(int variable, std::string const& unit, std::string const& long_name);
    int member_variable(std::string const& name, std::string const& unit, std::string const& long_name);
    void write_coordinates();
    void reserve_space();
    void write_column(int variable, BlockResult const& block, std::vector<double> const& values);

    std::string const path_, part_;
    ResultLayout const layout_;
    std::optional<NetcdfFile> file_;
    int member_dimension_ = 0, sample_dimension_ = 0;
    int member_ = -1, status_ = -1, time_ = -1;
    int steps_accepted_ = 0, steps_rejected_ = 0, rhs_evaluations_ = 0, jacobian_evaluations_ = 0, stiff_steps_ = 0,
        end_time_ = 0;
    std::vector<int> final_states_, parameters_, series_;
    std::vector<QuantityVariable> quantities_;
    struct LabelVariable {
        int id;
        std::vector<std::string> labels;
    };
    std::vector<LabelVariable> labels_;
    std::optional<SectionWriter> sections_;
    StudyColumnWriter study_;
};

}  // namespace slideway
