#include "spectral/text/csv.hpp"

#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "temporary_folder.hpp"

using hts::spectral::csv_field;
using hts::spectral::CsvReader;
using hts::spectral::CsvTable;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;

TEST_CASE("a CSV table has a header, rows and their lines") {
    const auto table =
        CsvTable::parse("# made by hand\n\nn, k ,note\n1.5,0,glass\n# a metal\n 0.77 , +6.08,x y\n", "a.csv");
    CHECK(table.name() == "a.csv");
    CHECK(table.columns() == std::vector<std::string>{"n", "k", "note"});
    REQUIRE(table.row_count() == 2);
    CHECK(table.line(0) == 4);
    CHECK(table.line(1) == 6);
    CHECK(table.number(0, 0) == 1.5);
    CHECK(table.number(1, table.column("k")) == 6.08);
    CHECK(table.text(1, 0) == "0.77");
    CHECK(table.text(1, 2) == "x y");
    CHECK_FALSE(table.find_column("albedo"));
    CHECK(table.find_column("note") == 2u);
}

TEST_CASE("byte order mark, CR LF and a last line without end are read") {
    const auto table = CsvTable::parse("\xEF\xBB\xBFn,k\r\n1,2\r\n\r\n3,4", "a.csv");
    CHECK(table.columns().front() == "n");
    REQUIRE(table.row_count() == 2);
    CHECK(table.text(0, 1) == "2");
    CHECK(table.number(1, 1) == 4);
    CHECK(table.line(1) == 4);
    CHECK(CsvTable::parse("n,k\n", "a.csv").row_count() == 0);
}

TEST_CASE("fields in quotation marks are read as they are written") {
    const auto table = CsvTable::parse("\"n\",\"the \"\"k\"\"\"\n\"1,5\",\" # \"\n", "a.csv");
    CHECK(table.columns()[1] == "the \"k\"");
    CHECK(table.text(0, 0) == "1,5");
    CHECK(table.text(0, 1) == " # ");
    for (const std::string text : {"plain", "1.5", "", "a,b", "say \"k\"", "#1", " x"}) {
        const auto back = CsvTable::parse("first,second\n" + csv_field(text) + ",0\n", "a.csv");
        CHECK(back.text(0, 0) == text);
    }
    CHECK(csv_field("x y") == "x y");
}

TEST_CASE("CSV that cannot be read is refused with path and line") {
    const std::pair<std::string, std::string> cases[] = {
        {"", "a.csv: no header line with the names of the columns"},
        {"# only this\n", "a.csv: no header line with the names of the columns"},
        {"n,k\n1,2\n1,2,3\n", "a.csv:3: 3 fields: must be 2 as in the header"},
        {"n,k\n\n1\n", "a.csv:3: 1 fields: must be 2 as in the header"},
        {"n,,k\n", "a.csv:1: column 2 has no name"},
        {"n,k,n\n", "a.csv:1: column \"n\": stands twice"},
        {"n\n\"1\n", "a.csv:2: quotation mark without its partner"},
        {"n\n\"1\"2\n", "a.csv:2: a comma must follow the closing quotation mark"},
        {"n,k\r1,2\r", "a.csv:1: lines end with CR alone: must end with LF or CR LF"},
        {std::string{"\xff\xfen\0,\0k\0\n\0", 10}, "a.csv:1: UTF-16: must be UTF-8 text"},
        {"n\xff\n", "a.csv:1: not UTF-8 text"},
    };
    for (const auto& [text, message] : cases) CHECK_THROWS_WITH(CsvTable::parse(text, "a.csv"), message);
}

TEST_CASE("a column that stands there in other letters, or beside a mark that separates none, is named") {
    const auto message = [](const std::string& header, const std::string& column) {
        try {
            static_cast<void>(CsvTable::parse(header + "\n", "a.csv").column(column));
        } catch (const hts::Error& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    CHECK(message("Theta_I_deg,brdf", "theta_i_deg") ==
          "a.csv:1: column \"theta_i_deg\": missing; must be written so, not \"Theta_I_deg\"");
    CHECK(message("theta_i_deg,brdf", "theta_r_deg") == "a.csv:1: column \"theta_r_deg\": missing");
    CHECK(
        message("g|t", "t") ==
        "a.csv:1: column \"t\": missing; fields must stand between commas, semicolons, tabs or white space, "
        "not \"|\"");
    CHECK(
        message("g/t", "g") ==
        "a.csv:1: column \"g\": missing; fields must stand between commas, semicolons, tabs or white space, "
        "not \"/\"");
    CHECK(message("albedo", "a") == "a.csv:1: column \"a\": missing");
}

TEST_CASE("wavelengths are in either unit") {
    const auto nm = CsvTable::parse("n,wavelength_nm\n1,550\n", "a.csv").wavelength();
    CHECK(nm.place == 1);
    CHECK(nm.micrometres(550) == 0.55);
    const auto um = CsvTable::parse("wavelength_um\n0.55\n", "a.csv").wavelength();
    CHECK(um.micrometres(0.55) == 0.55);
    CHECK_FALSE(CsvTable::parse("n\n", "a.csv").find_wavelength());
    CHECK_THROWS_WITH(CsvTable::parse("n\n", "a.csv").wavelength(),
                      "a.csv:1: column \"wavelength_um\": missing");
    CHECK_THROWS_WITH(CsvTable::parse("wavelength_um,wavelength_nm\n", "a.csv").find_wavelength(),
                      "a.csv:1: columns \"wavelength_um\" and \"wavelength_nm\": must be one of the two");
}

TEST_CASE("a CSV reader gives row after row, by the same rules") {
    auto reader = CsvReader::from_text(
        "\xEF\xBB\xBF# made by hand\n t , \"a,b\"\r\n1,2\n\n  # half way\n3,4\n5,6", "a.csv");
    CHECK(reader.columns() == std::vector<std::string>{"t", "a,b"});
    CHECK(reader.where_header() == "a.csv:2: ");
    hts::spectral::CsvLines lines;
    reader.take(2, lines);
    REQUIRE(lines.size() == 2);
    hts::spectral::CsvRow row{0, {"old", "fields", "of", "a longer row than this"}};
    reader.parse(lines, 1, row);
    CHECK(row.line == 6);
    CHECK(row.fields == std::vector<std::string>{"3", "4"});
    CHECK(reader.next().value().fields.front() == "5");
    CHECK_FALSE(reader.next());
    reader.take(2, lines);
    CHECK(lines.empty());
}

TEST_CASE("a CSV reader passes columns through that nobody asks for") {
    auto reader = CsvReader::from_text(",t,n,n\n0,1,2,3\n", "a.csv");
    CHECK(reader.column("t") == 1);
    CHECK_FALSE(reader.find_column("k"));
    CHECK_THROWS_WITH(reader.find_column("n"), "a.csv:1: column \"n\": stands twice");
    CHECK_THROWS_WITH(reader.column("k"), "a.csv:1: column \"k\": missing");
    CHECK(reader.next().value().fields.size() == 4);
}

TEST_CASE("a CSV reader refuses rows with path and line") {
    const auto complaint = [](const std::string& text) {
        try {
            auto reader = CsvReader::from_text(text, "a.csv");
            while (reader.next()) continue;
        } catch (const hts::Error& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    CHECK(complaint("#\n") == "a.csv: no header line with the names of the columns");
    CHECK(complaint("n,k\n1,2\n1\n") == "a.csv:3: 1 fields: must be 2 as in the header");
    CHECK(complaint("n\n\"1\n") == "a.csv:2: quotation mark without its partner");
    CHECK(complaint("n\n1 # \xB5m\n") == "a.csv:2: not UTF-8 text");
    CHECK(CsvReader::from_text("n\n1\n").where(2).empty());
    const TemporaryFolder folder;
    folder.write("empty.csv", "");
    const auto read = [&folder](const std::string& name) {
        return hts::testing::complaint(
            folder, [&] { static_cast<void>(CsvReader{(folder.path() / name).string()}); });
    };
    CHECK(read("none.csv") == "none.csv: no such file");
    CHECK(read(".") == ".: is a directory, not a file");
    CHECK(read("empty.csv") == "empty.csv: file is empty");
}

TEST_CASE("fields that are no number are refused with path, line and column") {
    const std::pair<std::string, std::string> cases[] = {
        {"abc", "\"abc\" is not a number"},
        {"", "\"\" is not a number"},
        {"1.5x", "\"1.5x\" is not a number"},
        {"1 2", "\"1 2\" is not a number"},
        {"1.5.2", "\"1.5.2\" is not a number"},
        {"+", "\"+\" is not a number"},
        {"+-1", "\"+-1\" is not a number"},
        {"0x10", "\"0x10\" is not a number"},
        {"NaN", "\"NaN\" is not a finite number"},
        {"-inf", "\"-inf\" is not a finite number"},
        {"1e999", "\"1e999\" is too large or too small for a number"},
    };
    for (const auto& [text, message] : cases) {
        const auto table = CsvTable::parse("n,k\n1," + text + "\n", "a.csv");
        CHECK_THROWS_WITH(table.number(0, 1), "a.csv:2: column \"k\": " + message);
    }
}

TEST_CASE("columns that are missing or unknown are refused") {
    const auto table = CsvTable::parse("#\nn,k\n1,2\n", "a.csv");
    CHECK_THROWS_WITH(table.column("x"), "a.csv:2: column \"x\": missing");
    CHECK_THROWS_WITH(table.require_known_columns({"n", "a"}),
                      "a.csv:2: column \"k\": not known; must be one of n, a");
    CHECK_NOTHROW(table.require_known_columns({"k", "n", "a"}));
    CHECK(std::string{table.error(0, "bad").what()} == "a.csv:3: bad");
    CHECK(std::string{table.error(0, 1, "bad").what()} == "a.csv:3: column \"k\": bad");
}

TEST_CASE("files that cannot be read are refused with their path") {
    const TemporaryFolder folder;
    const auto read = [&folder](const std::string& name) {
        return complaint(folder, [&] { static_cast<void>(CsvTable::read(folder.path() / name)); });
    };
    folder.write("good.csv", "n\n1\n");
    folder.write("empty.csv", "");
    folder.write("blank.csv", "\xEF\xBB\xBF \r\n\n");
    folder.write("latin.csv", "# \xB5m\nn\n1\n");
    folder.write("utf16.csv", std::string{"\xFF\xFEn\0", 4});
    folder.write("null.csv", std::string{"n\n1\0\n", 5});
    folder.write("cut.csv", "n\n1\n# \xE2\x82");
    folder.write("overlong.csv", "n\n\xC0\xAF\n");
    folder.write("surrogate.csv", "n\n\xED\xA0\x80\n");
    folder.write("unicode.csv", "# \xC2\xB5 \xE2\x82\xAC \xF0\x9F\x98\x80\nn\n1\n");
    std::filesystem::create_directory(folder.path() / "folder.csv");
    CHECK(read("good.csv").empty());
    CHECK(read("unicode.csv").empty());
    CHECK(read("none.csv") == "none.csv: no such file");
    CHECK(read("folder.csv") == "folder.csv: is a directory, not a file");
    CHECK(read("good.csv/below.csv") == "good.csv/below.csv: no such file");
    CHECK(read("empty.csv") == "empty.csv: file is empty");
    CHECK(read("blank.csv") == "blank.csv: file is empty");
    CHECK(read("latin.csv") == "latin.csv:1: not UTF-8 text");
    CHECK(read("utf16.csv") == "utf16.csv:1: UTF-16: must be UTF-8 text");
    CHECK(read("null.csv") == "null.csv:2: not UTF-8 text");
    CHECK(read("cut.csv") == "cut.csv:3: not UTF-8 text");
    CHECK(read("overlong.csv") == "overlong.csv:2: not UTF-8 text");
    CHECK(read("surrogate.csv") == "surrogate.csv:2: not UTF-8 text");
}
