// What damage a result tells of, and which part of it.
#include "host/store/result_view.hpp"

#include <array>
#include <functional>

#include <netcdf.h>
#include <sys/resource.h>

#include "host/base/error.hpp"
#include "host/store/result_layout.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::result_check_test {
namespace {

using Type = DataFile::Type;

class Sealed : public testing::OutputFolder {
protected:
    Sealed() {
        NetcdfFile file = NetcdfFile::create(path());
        std::array const member{file.add_dimension("member", 3)};
        int const status = file.add_variable("status", Type::int8, member);
        int const height = file.add_variable("height", Type::float64, member, true);
        file.put(height, "units", "m");
        file.put(DataFile::global, "scene", "schema = 1\n");
        file.put(DataFile::global, "title", "Gelenk, größer");  // a string of netCDF, as it is no ASCII
        file.put(DataFile::global, "threads", 2);
        auto const held_group = file.add_group(verification_group);
        DataFile& group = *held_group;
        int const checked = group.add_variable("difference", Type::float64, member);
        group.put(DataFile::global, "summary", "resolved");
        std::array const first{std::size_t{0}}, count{std::size_t{3}};
        std::array const statuses{'\0', '\0', '\1'};
        std::array const heights{1.0, 2.0, 3.0};
        file.write(status, first, count, statuses.data());
        file.write(height, first, count, heights.data());
        group.write(checked, first, count, heights.data());
        seal(file);
        file.close();
    }

    /// By netCDF itself, as a tool would.
    void edit(std::function<void(int file)> const& change) const {
        int file = 0;
        ASSERT_EQ(nc_open(path().c_str(), NC_WRITE, &file), NC_NOERR);
        change(file);
        ASSERT_EQ(nc_close(file), NC_NOERR);
    }
    std::string refusal() const {
        try {
            require_intact(path());
        } catch (FileError const& error) {
            return error.what();
        }
        return "";
    }
};

void put(int code) { ASSERT_EQ(code, NC_NOERR); }
int variable_of(int file, char const* name) {
    int variable = -1;
    EXPECT_EQ(nc_inq_varid(file, name, &variable), NC_NOERR);
    return variable;
}
int group_of(int file) {
    int group = -1;
    EXPECT_EQ(nc_inq_ncid(file, verification_group, &group), NC_NOERR);
    return group;
}

TEST_F(Sealed, IsIntactAndOfTheThirdFormat) {
    SealCheck const found = check_result(path());
    EXPECT_EQ(found.version, 3);
    EXPECT_TRUE(found.intact());
    EXPECT_EQ(found.foreign, "");
    EXPECT_EQ(found.damage(), "");
    EXPECT_EQ(found.payload.size(), 16u);
    EXPECT_EQ(found.metadata.size(), 16u);
    EXPECT_NO_THROW(require_intact(path()));
}

TEST_F(Sealed, TellsChangesOfWhatIsNoNumber) {
    struct Change {
        char const* what;
        std::function<void(int)> make;
    };
    double const seven = 7;
    std::size_t const second = 1;
    int const four = 4;
    Change const changes[] = {
        {"scene", [](int f) { put(nc_put_att_text(f, NC_GLOBAL, "scene", 11, "schema = 2\n")); }},
        {"a string", [](int f) { char const* other = "Gelenk, größes"; put(nc_put_att_string(f, NC_GLOBAL, "title", 1, &other)); }},
        {"a number", [&](int f) { put(nc_put_att_int(f, NC_GLOBAL, "threads", NC_INT, 1, &four)); }},
        {"its type", [](int f) { short const two = 2; put(nc_put_att_short(f, NC_GLOBAL, "threads", NC_SHORT, 1, &two)); }},
        {"another attribute", [](int f) { put(nc_put_att_text(f, NC_GLOBAL, "history", 1, "x")); }},
        {"one that is gone", [](int f) { put(nc_del_att(f, NC_GLOBAL, "scene")); }},
        {"its name", [](int f) { put(nc_rename_att(f, NC_GLOBAL, "scene", "scent")); }},
        {"unit of a variable", [](int f) { put(nc_put_att_text(f, variable_of(f, "height"), "units", 2, "mm")); }},
        {"name of a dimension", [](int f) { put(nc_rename_dim(f, 0, "menber")); }},
        {"format", [](int f) { put(nc_del_att(f, NC_GLOBAL, "format_version")); }},
        {"hash", [](int f) { put(nc_del_att(f, NC_GLOBAL, "metadata_hash")); }},
        {"attribute of the group", [](int f) { put(nc_put_att_text(group_of(f), NC_GLOBAL, "summary", 8, "resolvee")); }},
        {"data of the group", [&](int f) { put(nc_put_var1_double(group_of(f), variable_of(group_of(f), "difference"), &second, &seven)); }},
    };
    std::string const whole = testing::bytes_of(path());
    for (Change const& change : changes) {
        testing::put(path(), whole);
        edit(change.make);
        SealCheck const found = check_result(path());
        EXPECT_FALSE(found.metadata_match()) << change.what;
        EXPECT_TRUE(found.data_match()) << change.what;
        EXPECT_EQ(refusal(), path() + ": the attributes, names or group verification do not match their hash; the file is damaged or was edited, "
                                      "see slideway info") << change.what;
    }
}

/// Whatever is added is told, of whatever type; what no hash covers by its name.
TEST_F(Sealed, TellsWhatSlidewayDidNotWrite) {
    struct Addition {
        std::function<void(int)> make;
        std::string named;  // "" where a hash tells of it
    };
    auto const variable = [](nc_type type) {
        return [type](int f) {
            int id = -1;
            int const dimension = 0;
            put(nc_def_var(f, "extra", type, 1, &dimension, &id));
        };
    };
    auto const in_group = [](nc_type type) {
        return [type](int f) {
            int id = -1;
            put(nc_def_var(group_of(f), "extra", type, 0, nullptr, &id));
        };
    };
    auto const user_type = [](int f) {
        nc_type type = 0;
        put(nc_def_opaque(f, 3, "mine", &type));
        put(nc_put_att(f, NC_GLOBAL, "note", type, 1, "abc"));
    };
    std::vector<Addition> additions{
        {variable(NC_FLOAT), "variable extra of type float"},     {variable(NC_INT64), "variable extra of type int64"},
        {variable(NC_STRING), "variable extra of type string"},   {variable(NC_SHORT), "variable extra of type short"},
        {variable(NC_UINT), "variable extra of type uint"},       {variable(NC_UBYTE), "variable extra of type ubyte"},
        {in_group(NC_FLOAT), "variable verification/extra of type float"},
        {[](int f) { nc_type type = 0; put(nc_def_compound(f, 8, "mine", &type)); put(nc_insert_compound(f, type, "x", 0, NC_DOUBLE)); }, "type mine"},
        {[](int f) { nc_type type = 0; put(nc_def_enum(f, NC_BYTE, "mine", &type)); put(nc_insert_enum(f, type, "x", "")); }, "type mine"},
        {user_type, "type mine, attribute note"},
        {variable(NC_DOUBLE), ""},
        {variable(NC_INT), ""},
        {variable(NC_CHAR), ""},
        {[](int f) { int group = 0; put(nc_def_grp(f, "extra", &group)); }, ""},
        {[](int f) { int dimension = 0; put(nc_def_dim(f, "extra", 3, &dimension)); }, ""},
        {[](int f) { int dimension = 0; put(nc_def_dim(f, "extra", NC_UNLIMITED, &dimension)); }, ""},
        {[](int f) { float const x = 1; put(nc_put_att_float(f, 0, "extra", NC_FLOAT, 1, &x)); }, ""},
    };
    std::string const whole = testing::bytes_of(path());
    for (std::size_t i = 0; i < additions.size(); ++i) {
        testing::put(path(), whole);
        edit(additions[i].make);
        SealCheck const found = check_result(path());
        EXPECT_FALSE(found.intact()) << i;
        EXPECT_EQ(found.foreign, additions[i].named) << i;
        EXPECT_NE(refusal(), "") << i;
    }
}

TEST_F(Sealed, TellsChangesOfNumbers) {
    double const seven = 7;
    std::size_t const second = 1;
    auto const change = [&](int f) { put(nc_put_var1_double(f, variable_of(f, "height"), &second, &seven)); };
    edit(change);
    EXPECT_TRUE(check_result(path()).metadata_match());
    EXPECT_NE(refusal().find(": the data do not match their hash; "), std::string::npos) << refusal();
    edit([](int f) { put(nc_put_att_text(f, NC_GLOBAL, "scene", 1, "x")); });
    EXPECT_NE(refusal().find(": neither the data nor the attributes match their hashes; "), std::string::npos) << refusal();
}

TEST_F(Sealed, OfANewerFormatIsRefused) {
    int const four = 4;
    edit([&](int f) { put(nc_put_att_int(f, NC_GLOBAL, "format_version", NC_INT, 1, &four)); });
    EXPECT_NE(refusal().find(": is of format 4, and slideway "), std::string::npos) << refusal();
    EXPECT_NE(refusal().find("reads formats 1 to 3"), std::string::npos) << refusal();
    EXPECT_EQ(refusal().find('\n'), std::string::npos);
}

TEST_F(Sealed, IsHashedAlikeInMemoryAndOnTheDisk) {
    NetcdfFile file = NetcdfFile::create_in_memory("a file");
    for (char const* const name : {"b", "a"}) {
        std::array const dimension{file.add_dimension(name, 1)};
        file.put(file.add_variable(name, Type::int32, dimension), "scale", 0.5);
    }
    seal(file);
    std::vector<std::byte> const bytes = file.close_to_bytes();
    SealCheck const found = check_seal(NetcdfFile::open_in_memory("a file", bytes));
    EXPECT_TRUE(found.intact()) << found.damage();
}

TEST_F(Sealed, WithAnyByteChangedIsRefusedOrTheSame) {
    std::string const whole = testing::bytes_of(path());
    SealCheck const before = check_result(path());
    std::size_t refused = 0, same = 0;
    for (std::size_t at = 0; at < whole.size(); at += 53) {  // the slow tests change every byte
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0x55);
        testing::put(path(), changed);
        try {
            SealCheck const found = check_result(path());
            if (!found.intact()) {
                ++refused;
                continue;
            }
            ++same;  // no part of what is read
            EXPECT_EQ(found.payload_found, before.payload_found) << at;
            EXPECT_EQ(found.metadata_found, before.metadata_found) << at;
        } catch (FileError const& error) {
            ++refused;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << at << error.what();
        }
    }
    EXPECT_GT(refused, 50u);
    EXPECT_GT(same, 0u);
}

/// MPI does not outlive a fork: a rank of a job looks for itself, any other process has one that looks for it.
TEST_F(Sealed, IsLookedAtWithoutAForkByARankOfAJob) {
    auto const faults_of_children = [] {
        rusage usage{};
        getrusage(RUSAGE_CHILDREN, &usage);
        return usage.ru_minflt;
    };
    long before = faults_of_children();
    EXPECT_TRUE(check_result(path()).intact());
    EXPECT_GT(faults_of_children(), before);
    setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
    before = faults_of_children();
    EXPECT_TRUE(check_result(path()).intact());
    EXPECT_FALSE(is_result_file(path("none.nc")));
    EXPECT_EQ(faults_of_children(), before);
    unsetenv("OMPI_COMM_WORLD_SIZE");
}

TEST(FirstFormat, IsRead) {
    SealCheck const found = check_result(std::string(SLIDEWAY_TEST_DATA) + "/formats/result_1.nc");
    EXPECT_EQ(found.version, 1);
    EXPECT_EQ(found.payload, "26acfe69637576dd");  // as the program that wrote it said
    EXPECT_EQ(found.metadata, "");
    EXPECT_TRUE(found.intact());
}

TEST(SecondFormat, IsReadUnderTheNamesOfNow) {
    std::string const file = std::string(SLIDEWAY_TEST_DATA) + "/formats/result_2.nc";
    SealCheck const found = check_result(file);
    EXPECT_EQ(found.version, 2);
    EXPECT_EQ(found.payload, "6d4794e08e9d756b");  // as the program that wrote it said
    EXPECT_TRUE(found.intact());
    ResultReader const results(file);
    EXPECT_FALSE(results.has("crank_work"));
    EXPECT_EQ(results.values("drive_work").size(), 6u);
    EXPECT_EQ(results.values("drive_work"), results.column("drive_work", 0));
    std::vector<std::string> names;
    for (QuantityColumn const& column : stored_columns(results)) names.push_back(column.name());
    EXPECT_EQ(names, (std::vector<std::string>{"peak_normal_force", "drive_work"}));
}

TEST_F(Sealed, ThatIsNoFileIsRefusedAtOnce) {
    EXPECT_THROW(check_result(path("missing.nc")), FileError);
    EXPECT_THROW(check_result(folder()), FileError);
    EXPECT_THROW(check_result("/dev/zero"), FileError);
    EXPECT_FALSE(is_result_file("/dev/zero"));
    EXPECT_TRUE(is_result_file(path()));
}

}  // namespace
}  // namespace slideway::result_check_test
