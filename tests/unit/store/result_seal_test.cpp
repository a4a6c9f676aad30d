#include "host/base/bytes.hpp"
#include "host/store/result_seal.hpp"

#include <cstdio>
#include <cstdlib>

#include "host/store/run_identity.hpp"
#include "tests/support/output_fixture.hpp"

namespace slideway::result_seal_test {
namespace {

class PayloadHash : public testing::OutputFolder {};

std::uint64_t fnv(std::string_view text) {
    Fnv1a hash;
    hash.add(text);
    return hash.value();
}

TEST(Fnv1a, MeetsPublishedValues) {  // Fowler, Noll, Vo: test vectors of the reference implementation
    EXPECT_EQ(fnv(""), 0xcbf29ce484222325u);
    EXPECT_EQ(fnv("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(fnv("foobar"), 0x85944171f73967e8u);
}

TEST_F(PayloadHash, CoversNamesShapesAndData) {
    // The definition of result_seal.hpp, written out for a file of two variables: by name, not as they were defined.
    std::vector<double> const values{1.5, -2.0};
    int const scalar = 7;
    {
        NetcdfFile file = NetcdfFile::create(path());
        int const dimension = file.add_dimension("n", 2);
        int const last = file.add_variable("w", DataFile::Type::int32, {});
        int const variable = file.add_variable("v", DataFile::Type::float64, {&dimension, 1});
        std::size_t const start = 0, count = 2;
        file.write(variable, {&start, 1}, {&count, 1}, values.data());
        file.write(last, {}, {}, &scalar);
        file.close();
    }
    std::string bytes = "v";
    for (unsigned char const low : {1, 2}) bytes += std::string{static_cast<char>(low)} + std::string(7, '\0');
    bytes.append(reinterpret_cast<char const*>(values.data()), 16);
    bytes += "w" + std::string(8, '\0');
    bytes.append(reinterpret_cast<char const*>(&scalar), 4);
    char expected[17];
    std::snprintf(expected, sizeof expected, "%016llx", static_cast<unsigned long long>(fnv(bytes)));
    EXPECT_EQ(payload_hash(NetcdfFile::open(path())), expected);
}

TEST(CreationTime, IgnoresAnEpochThatIsNoNumber) {
    for (char const* const text : {"", "soon", "12x", "-1"}) {
        setenv("SOURCE_DATE_EPOCH", text, 1);
        std::string const now = creation_time();
        EXPECT_GT(now.substr(0, 4), "2023") << text;
        EXPECT_EQ(now.size(), 20u);
    }
    unsetenv("SOURCE_DATE_EPOCH");
}

}  // namespace
}  // namespace slideway::result_seal_test
