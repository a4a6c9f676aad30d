// The variables of a result file (NetCDF-4, CF-1.8): that of a whole run and that of a shard are defined alike.
#pragma once

#include <vector>

#include "host/store/data_file.hpp"
#include "host/store/provenance.hpp"
#include "host/store/result_layout.hpp"

namespace slideway {

/// Their numbers in the file.
struct ResultVariables {
    struct Quantity {
        int id;
        std::size_t first_column, columns;
    };
    int member = -1, status = -1, time = -1, label = -1;
    int end_time = -1;
    std::vector<int> work;  // of the work_table
    std::vector<int> final_states, parameters, series;
    std::vector<Quantity> quantities;
    std::vector<int> study;  // the columns of the layout's study
    int section_count = -1, section_crossings = -1;
    std::vector<int> section_columns;
};

/// Defines and describes the variables, and writes what is known before any member is: coordinates, members' numbers, and for each member
/// that it was not run.  @throws FileError, also if the members do not fit the file's 32-bit numbers.
ResultVariables define_result(DataFile& file, ResultLayout const& layout, Provenance const& provenance);
/// The same without where it comes from.
ResultVariables define_variables(DataFile& file, ResultLayout const& layout);

/// Attribute `quantities`: the names of those that a file is of, for readers that do not know the mechanism.  None without any.
void put_quantity_names(DataFile& file, ResultLayout const& layout);
/// Attributes that say where a result comes from.
void put_provenance(DataFile& file, Provenance const& provenance);
/// `flag_values` and `flag_meanings` of a variable that holds statuses.
void put_status_flags(DataFile& file, int variable);

}  // namespace slideway
