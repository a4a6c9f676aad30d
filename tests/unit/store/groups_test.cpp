#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/store/netcdf_file.hpp"
#include "host/store/result_seal.hpp"
#include "host/store/result_view.hpp"

namespace slideway::groups_test {
namespace {

namespace fs = std::filesystem;
using Type = DataFile::Type;
using Lengths = std::vector<std::size_t>;

class Groups : public ::testing::Test {
protected:
    Groups() : folder_(fs::temp_directory_path() / ("slideway_groups_test_" + std::to_string(getpid()))) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~Groups() override { fs::remove_all(folder_); }
    std::string path(std::string const& name = "out.nc") const { return (folder_ / name).string(); }

private:
    fs::path folder_;
};

/// A variable of doubles along dimensions of known lengths.
void put(DataFile& file, std::string const& name, std::vector<int> const& dimensions, Lengths const& lengths,
         std::vector<double> const& values) {
    int const variable = file.add_variable(name, Type::float64, dimensions);
    file.write(variable, Lengths(lengths.size(), 0), lengths, values.data());
}

std::vector<double> get(DataFile const& file, std::string const& name) {
    for (auto const& variable : file.variables()) {
        if (variable.name != name) continue;
        std::vector<double> values(variable.size());
        file.read(variable.id, Lengths(variable.shape.size(), 0), variable.shape, values.data());
        return values;
    }
    return {};
}

TEST_F(Groups, HoldVariablesOverDimensionsOfTheFileAndTheirOwn) {
    {
        NetcdfFile file = NetcdfFile::create(path());
        int const member = file.add_dimension("member", 2);
        put(file, "x", {member}, {2}, {1, 2});
        auto const held_group = file.add_group("statistics");
        DataFile& group = *held_group;
        int const bound = group.add_dimension("bound", 3);
        put(group, "x", {member, bound}, {2, 3}, {1, 2, 3, 4, 5, 6});
        group.put(DataFile::global, "policy", "all of them");
        auto const held_inner = group.add_group("inner");
        DataFile& inner = *held_inner;
        put(inner, "y", {inner.dimension("bound")}, {3}, {7, 8, 9});
        file.close();
    }
    NetcdfFile const file = NetcdfFile::open(path());
    EXPECT_EQ(file.groups(), (std::vector<std::string>{"statistics"}));
    EXPECT_TRUE(file.has_group("statistics"));
    EXPECT_FALSE(file.has_group("yield"));
    EXPECT_EQ(get(file, "x"), (std::vector<double>{1, 2}));
    auto const held_group = file.group("statistics");
    DataFile const& group = *held_group;
    EXPECT_EQ(get(group, "x"), (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(group.text(DataFile::global, "policy"), "all of them");
    EXPECT_EQ(file.text(DataFile::global, "policy"), "");
    ASSERT_EQ(group.dimensions().size(), 1u);  // its own
    EXPECT_EQ(group.dimensions()[0].name, "bound");
    EXPECT_EQ(group.dimensions()[0].length, 3u);
    EXPECT_EQ(get(*group.group("inner"), "y"), (std::vector<double>{7, 8, 9}));
    EXPECT_THROW(file.group("yield"), FileError);
    EXPECT_THROW(file.dimension("bound"), FileError);  // of the group alone
}

TEST_F(Groups, EndBeforeTheirFileWithoutClosingIt) {
    NetcdfFile file = NetcdfFile::create(path());
    file.add_group("a");
    int const n = file.add_dimension("n", 1);
    put(file, "x", {n}, {1}, {5});
    NetcdfFile const moved = std::move(file);
    EXPECT_EQ(get(moved, "x"), (std::vector<double>{5}));
    EXPECT_EQ(moved.groups(), (std::vector<std::string>{"a"}));
}

/// 64-bit FNV-1a of the documented bytes.
struct ExpectedHash {
    Fnv1a hash;
    void name(std::string_view text) { hash.add(text); }
    void variable(std::string_view text, std::vector<double> const& values) {
        hash.add(text);
        hash.add(std::uint64_t{1});
        hash.add(std::uint64_t{values.size()});
        hash.add(std::as_bytes(std::span(values)));
    }
    std::string text() const {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash.value()));
        return digits;
    }
};

TEST_F(Groups, FollowTheFilesVariablesInTheHash) {
    auto const write = [&](std::string const& name, double last) {
        NetcdfFile file = NetcdfFile::create(path(name));
        int const n = file.add_dimension("n", 2);
        put(file, "x", {n}, {2}, {1, 2});
        auto const held_second = file.add_group("z_first");
        DataFile& second = *held_second;  // by definition, not by name
        put(second, "y", {n}, {2}, {3, 4});
        auto const held_third = file.add_group("a_second");
        DataFile& third = *held_third;
        put(third, "y", {n}, {2}, {5, last});
        file.close();
    };
    write("a.nc", 6);
    write("b.nc", 7);
    ExpectedHash expected;
    expected.variable("x", {1, 2});
    expected.name("z_first");
    expected.variable("y", {3, 4});
    expected.name("a_second");
    expected.variable("y", {5, 6});
    EXPECT_EQ(payload_hash(NetcdfFile::open(path("a.nc"))), expected.text());
    EXPECT_NE(payload_hash(NetcdfFile::open(path("b.nc"))), expected.text());
}

TEST_F(Groups, AViewReadsAResultThatIsStillOpen) {
    NetcdfFile file = NetcdfFile::create(path());
    EXPECT_THROW(ResultView{file}, FileError);  // no status
    int const member = file.add_dimension("member", 2), apex = file.add_dimension("apex", 3);
    int const status = file.add_variable("status", Type::int8, std::array{member});
    std::vector<signed char> const statuses{0, -1};
    file.write(status, Lengths{0}, Lengths{2}, statuses.data());
    put(file, "force", {member, apex}, {2, 3}, {1, 2, 3, 4, 5, 6});
    put(file, "work", {member}, {2}, {7, 8});
    ResultView const view(file);
    EXPECT_EQ(view.values("status"), (std::vector<double>{0, -1}));
    EXPECT_EQ(view.column("force", 1), (std::vector<double>{2, 5}));
    EXPECT_EQ(view.column("work", 0), (std::vector<double>{7, 8}));
    EXPECT_THROW(view.column("force", 3), FileError);
    EXPECT_THROW(view.column("work", 1), FileError);
    EXPECT_THROW(view.column("status", 0), FileError);
    EXPECT_EQ(view.path(), path());
    file.close();
    EXPECT_THROW(ResultReader{path()}, FileError);  // without a hash it is unfinished
}

}  // namespace
}  // namespace slideway::groups_test
