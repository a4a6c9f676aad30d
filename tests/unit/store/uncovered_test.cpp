// What a result holds that netCDF-4 shows to nobody.
#include "host/store/result_seal.hpp"

#include <array>

#include <hdf5.h>

#include "host/base/error.hpp"
#include "host/store/result_view.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::uncovered_test {
namespace {

class Uncovered : public testing::OutputFolder {
protected:
    Uncovered() {
        NetcdfFile file = NetcdfFile::create(path());
        std::array const member{file.add_dimension("member", 3)};
        file.add_variable("status", DataFile::Type::int8, member);
        file.put(file.add_variable("height", DataFile::Type::float64, member, true), "units", "m");
        file.add_variable("member", DataFile::Type::int32, member);
        std::array const none{file.add_dimension("other", 2)};
        // Of the name of a dimension, and not along it.
        file.add_variable("other", DataFile::Type::int32, member);
        file.add_variable("along", DataFile::Type::int32, none);
        file.add_group("statistics")->add_dimension("bin", 4);
        std::array<char, 3> const statuses{};
        file.write(file.variables()[0].id, statuses.data());
        seal(file);
        file.close();
        whole_ = testing::bytes_of(path());
    }

    /// What is told of the file once HDF5 has changed it.
    template <class Change> std::string told_of(Change const& change) const {
        testing::put(path(), whole_);
        hid_t const file = H5Fopen(path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        change(file);
        EXPECT_GE(H5Fclose(file), 0);
        return check_result(path()).foreign;
    }

    static void add_reference(hid_t file, char const* object, char const* name) {
        hid_t const space = H5Screate(H5S_SCALAR);
        hid_t const note = H5Acreate_by_name(file, object, name, H5T_STD_REF_OBJ, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        EXPECT_GE(H5Aclose(note), 0);
        H5Sclose(space);
    }

    std::string whole_;
};

TEST_F(Uncovered, IsNothingOfAResult) {
    EXPECT_EQ(told_of([](hid_t) {}), "");
    EXPECT_TRUE(check_result(path()).intact());
}

TEST_F(Uncovered, AreVariablesOfTypesThatNetcdfLacks) {
    for (std::string const name : {"seen", "statistics/seen"}) {
        EXPECT_EQ(told_of([&](hid_t file) {
            hid_t const space = H5Screate(H5S_SCALAR);
            EXPECT_GE(H5Dclose(H5Dcreate2(file, name.c_str(), H5T_STD_REF_OBJ, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)), 0);
            H5Sclose(space);
        }), "object " + name);
    }
}

/// netCDF takes a link for what it leads to, and fails where that is not there.
TEST_F(Uncovered, LinksAreRefusedToo) {
    for (char const* const to : {"/height", "/nothing"}) {
        auto const link = [&](hid_t file) { EXPECT_GE(H5Lcreate_soft(to, file, "alias", H5P_DEFAULT, H5P_DEFAULT), 0); };
        EXPECT_THROW((told_of(link), require_intact(path())), FileError) << to;
    }
}

TEST_F(Uncovered, AreAttributesOfTypesThatNetcdfLacks) {
    EXPECT_EQ(told_of([](hid_t file) { add_reference(file, "height", "seen"); }), "attribute of height: seen");
    EXPECT_EQ(told_of([](hid_t file) { add_reference(file, "/", "seen"); }), "attribute seen");
    EXPECT_EQ(told_of([](hid_t file) { add_reference(file, "statistics/bin", "seen"); }), "attribute of statistics/bin: seen");
}

}  // namespace
}  // namespace slideway::uncovered_test
