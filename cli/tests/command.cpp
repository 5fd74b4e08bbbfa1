#include "command.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace hts::cli::testing {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
    std::ifstream in{path, std::ios::binary};
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

}  // namespace

Workplace::Workplace() {
    fs::create_directory(folder());
}

Result Workplace::hts(const std::string& arguments, const std::string& environment) const {
    const std::string command = "cd '" + folder().string() + "' && " + environment + " '" HTS_COMMAND "' " +
                                arguments + " >../output 2>../errors";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder_ / "output"),
            contents(folder_ / "errors")};
}

std::string Workplace::file(const std::string& name, const std::string& text) const {
    std::ofstream{folder() / name, std::ios::binary} << text;
    return name;
}

std::string Workplace::read(const std::string& name) const {
    return contents(folder() / name);
}

std::vector<std::string> Workplace::names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator{folder()}) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

void check_complaint(const Result& result, int exit_code, const std::vector<std::string>& parts) {
    INFO(result.errors);
    CHECK(result.exit_code == exit_code);
    CHECK(result.output.empty());
    CHECK(result.errors.starts_with("hts: "));
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    for (const std::string& part : parts) {
        INFO("must name: " << part);
        CHECK(result.errors.find(part) != std::string::npos);
    }
}

std::vector<std::vector<std::string>> cells(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines{csv};
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields{line};
        rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

}  // namespace hts::cli::testing
