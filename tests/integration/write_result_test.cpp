// A result file is written by one process at a time, and is whole or not there.
#include "host/base/error.hpp"
#include "host/store/netcdf_file.hpp"
#include "tests/support/output_fixture.hpp"

#include <sys/file.h>
#include <sys/wait.h>

namespace slideway::write_result_test {
namespace {

class WrittenResult : public testing::OutputFolder {
protected:
    static void put_value(NetcdfFile& file, double value) {
        int const variable = file.add_variable("value", DataFile::Type::float64, {});
        std::size_t const none = 0;
        file.write(variable, {&none, 0}, {&none, 0}, &value);
    }
    void write_value(double value) const {
        slideway::write_result(path(), "complete", [&](NetcdfFile& file) { put_value(file, value); });
    }
    double value() const {
        NetcdfFile const file = NetcdfFile::open(path());
        std::size_t const none = 0;
        double found = 0;
        file.read(file.variables().front().id, {&none, 0}, {&none, 0}, &found);
        return found;
    }
    std::string refusal() const {
        try {
            write_value(2);
        } catch (FileError const& error) {
            return error.what();
        }
        return "";
    }
    void expect_nothing_beside() const {
        EXPECT_FALSE(exists("out.nc.part"));
        EXPECT_FALSE(exists("out.nc.part.lock"));
    }
};

TEST_F(WrittenResult, IsRefusedToASecondWriterEvenWithoutTheLocksOfHdf5) {
    for (char const* const locks : {"TRUE", "FALSE"}) {
        setenv("HDF5_USE_FILE_LOCKING", locks, 1);
        slideway::write_result(path(), "complete", [&](NetcdfFile& file) {
            // Another process, for HDF5 knows its own files.
            pid_t const child = fork();
            if (child == 0) {
                std::string const line = refusal();
                _exit(line == path() + ": is being written by process " + std::to_string(getppid()) + "; wait for its end or give another name with -o"
                          ? 7
                          : 8);
            }
            int status = 0;
            waitpid(child, &status, 0);
            EXPECT_EQ(WEXITSTATUS(status), 7) << locks;
            put_value(file, 1);
        });
        unsetenv("HDF5_USE_FILE_LOCKING");
        EXPECT_EQ(value(), 1);
        expect_nothing_beside();
    }
}

TEST_F(WrittenResult, IsWrittenWhereAKilledWriterLeftItsFiles) {
    testing::put(path("out.nc.part"), "half a file");
    testing::put(path("out.nc.part.lock"), "");
    write_value(3);
    EXPECT_EQ(value(), 3);
    expect_nothing_beside();
    testing::put(path("out.nc.part.lock"), "");
    remove_merge_lock(path());
    expect_nothing_beside();
    EXPECT_NO_THROW(remove_merge_lock(path()));
}

TEST_F(WrittenResult, LeavesNothingWhereItFails) {
    struct Failure {};
    EXPECT_THROW(slideway::write_result(path(), "complete", [](NetcdfFile&) { throw Failure(); }), Failure);
    EXPECT_FALSE(exists("out.nc"));
    expect_nothing_beside();
}

TEST_F(WrittenResult, LeavesNothingWhereTheFileDoesNotHoldWhatWasWritten) {
    write_value(1);
    // Another file comes into its place before it is read again.
    std::string const part = path("out.nc.part");
    EXPECT_THROW(slideway::write_result(path(), "complete",
                                        [&](NetcdfFile& file) {
                                            put_value(file, 2);
                                            std::filesystem::rename(part, path("away.nc"));
                                            testing::put(part, "something else");
                                        }),
                 FileError);
    EXPECT_EQ(value(), 1);
    expect_nothing_beside();
}

TEST_F(WrittenResult, ClosesWhereItsNameIsGone) {
    {
        NetcdfFile file = NetcdfFile::create(path("gone.nc"));
        put_value(file, 1);
        std::filesystem::remove(path("gone.nc"));
        EXPECT_NO_THROW(file.close());
    }
    NetcdfFile file = NetcdfFile::create(path("left.nc"));
    put_value(file, 1);
    std::filesystem::remove(path("left.nc"));
}

}  // namespace
}  // namespace slideway::write_result_test
