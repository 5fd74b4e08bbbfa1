#include "spectral/text/npy.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "temporary_folder.hpp"

using hts::spectral::CsvReader;
using hts::spectral::NpyReader;

namespace {

template <class T>
std::string bytes_of(T value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

/// A file of version 1 with this header.
std::string npy(const std::string& header) {
    std::string bytes = "\x93NUMPY";
    bytes += '\1';
    bytes += '\0';
    return bytes + bytes_of(static_cast<std::uint16_t>(header.size())) + header;
}

std::string with_fields(const std::string& fields, const std::string& shape) {
    return npy("{'descr': [" + fields + "], 'fortran_order': False, 'shape': " + shape + ", }     \n");
}

class Files {
  public:
    std::string file(const std::string& bytes) {
        const std::string path = folder_ / "a.npy";
        std::ofstream{path, std::ios::binary} << bytes;
        return path;
    }
    std::string complaint(const std::string& bytes) {
        const std::string path = file(bytes);
        try {
            NpyReader reader{path};
            for (std::string row; reader.take(row);) continue;
        } catch (const hts::Error& error) {
            return std::string{error.what()}.substr(path.size());
        }
        return {};
    }

  private:
    hts::testing::TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("structured arrays of NumPy are tables") {
    Files files;
    const std::string rows = bytes_of(0.1) + bytes_of(1.5F) + bytes_of(std::int64_t{-3}) +
                             bytes_of(std::int32_t{7}) + bytes_of(1e300) + bytes_of(-2.0F) +
                             bytes_of(std::int64_t{1} << 40) + bytes_of(std::int32_t{-1});
    const std::string path =
        files.file(with_fields("('t', '<f8'), ('a b', '<f4'), ('n', '<i8'), ('k', '<i4')", "(2,)") + rows);
    CsvReader reader{path};
    CHECK(reader.columns() == std::vector<std::string>{"t", "a b", "n", "k"});
    CHECK(reader.where_header() == path + ": ");
    CHECK(reader.next().value().numbers == std::vector<double>{0.1, 1.5, -3, 7});
    const auto second = reader.next().value();
    CHECK(second.line == 2);
    CHECK(second.numbers == std::vector<double>{1e300, -2, 0x1p40, -1});
    CHECK(second.number(reader.column("k"), "k") == -1);
    CHECK_FALSE(reader.next());
}

TEST_CASE("a number that is not finite is refused by its name") {
    Files files;
    CsvReader reader{files.file(with_fields("('t', '<f8')", "(1,)") + bytes_of(0.0 / 1e-300 + 1e308 * 10))};
    CHECK_THROWS_WITH(reader.next().value().number(0, "t"), "t: inf is not a finite number");
}

TEST_CASE("what hts writes as .npy it reads") {
    Files files;
    const std::vector<std::string> columns{"theta_i_deg", "brdf"};
    const std::string empty = hts::spectral::npy_header(columns, 0),
                      header = hts::spectral::npy_header(columns, 2);
    CHECK(empty.size() == header.size());
    CHECK(header.size() % 64 == 0);
    CHECK(header.back() == '\n');
    NpyReader reader{files.file(header + bytes_of(1.0) + bytes_of(2.0) + bytes_of(3.0) + bytes_of(4.0))};
    CHECK(reader.columns() == columns);
    std::string row;
    std::vector<double> numbers;
    REQUIRE((reader.take(row) && reader.take(row)));
    reader.numbers(row, numbers);
    CHECK(numbers == std::vector<double>{3, 4});
    CHECK_FALSE(reader.take(row));
}

TEST_CASE("other files of NumPy, and damaged ones, are refused") {
    Files files;
    const std::string structured =
        ": must be a structured array of one dimension, whose fields are the columns, as np.rec.fromarrays "
        "makes it";
    CHECK(files.complaint("theta\n1\n") == ": not a .npy file of NumPy");
    CHECK(files.complaint("\x93NUMPY") == ": not a .npy file of NumPy");
    CHECK(files.complaint(npy("{'descr': [").substr(0, 15)) ==
          ": not a .npy file of NumPy: its header is damaged");
    CHECK(files.complaint(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }")) == structured);
    CHECK(files.complaint(with_fields("('t', '<f8')", "(2, 2)")) == structured);
    CHECK(files.complaint(with_fields("('t', '>f8')", "(1,)")) ==
          ": field \"t\" is of type \">f8\": must be <f8, <f4, <i8 or <i4");
    CHECK(
        files.complaint(with_fields("('t', '<f8', (3,))", "(1,)")).find("must be numbers with plain names") !=
        std::string::npos);
    CHECK(files.complaint(with_fields("('t', '<f8')", "(3,)") + bytes_of(1.0) + bytes_of(2.0F)) ==
          ": ends after 1 rows: must have 3 as its header says");
}
