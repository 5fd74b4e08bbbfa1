// What the command says of itself, and that it is the same for all verbs.

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "command.hpp"

namespace {

using namespace hts::cli::testing;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream{text};
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Letters, not bytes.
std::ptrdiff_t width(const std::string& line) {
    return std::ranges::count_if(line,
                                 [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

/// The verbs that a help text lists.
std::vector<std::string> verbs_in(const std::string& help) {
    std::vector<std::string> verbs;
    bool listed = false;
    for (const std::string& line : lines_of(help)) {
        listed = line == "Subcommands:" || (listed && line.starts_with("  "));
        if (listed && line.starts_with("  ") && line[2] != ' ')
            verbs.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    return verbs;
}

/// Every verb as it is called, "" for none.
std::vector<std::string> all_verbs(const Workplace& place) {
    std::vector<std::string> all{""};
    for (const std::string& verb : verbs_in(place.hts("--help").output)) {
        all.push_back(verb);
        for (const std::string& below : verbs_in(place.hts(verb + " --help").output))
            all.push_back(verb + " " + below);
    }
    return all;
}

const std::string m = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";
const std::string angles = " --wavelength 0.5 --theta-i 30 --theta-r 40 --phi 170";

}  // namespace

TEST_CASE("help: every page fits 80 columns, and hts help VERB is hts VERB --help") {
    const Workplace place;
    const auto verbs = all_verbs(place);
    CHECK(verbs.size() > 30);
    for (const std::string& verb : verbs) {
        INFO("hts " << verb << " --help");
        const auto help = place.hts(verb + " --help");
        CHECK(help.exit_code == 0);
        for (const std::string& line : lines_of(help.output)) {
            INFO(line);
            CHECK(width(line) <= 80);
        }
        const auto asked = place.hts("help " + verb);
        CHECK(asked.exit_code == 0);
        CHECK(asked.output == help.output);
    }
    CHECK(place.hts("table help build").output == place.hts("table build --help").output);
}

TEST_CASE("one interface: a material as an argument or an option, angles and counts by any of their names") {
    const Workplace place;
    const auto same = [&](const std::string& one, const std::string& other) {
        INFO(one << " | " << other);
        const auto a = place.hts(one), b = place.hts(other);
        CHECK(a.exit_code == 0);
        CHECK(!a.output.empty());
        CHECK(a.output == b.output);
    };
    same("eval -m " + m + angles, "eval " + m + angles);
    same("eval -m " + m + angles,
         "eval --material " + m + " --wavelength 0.5 --theta 30 --theta-r 40 --phi 170");
    same("info " + m + " --wavelengths 0.5 --theta 30,60",
         "info -m " + m + " --wavelength 0.5 --theta-i 30,60");
    same("albedo -m " + m + " --wavelengths 0.5 --theta-i 30,60",
         "albedo " + m + " --wavelength 0.5 --theta 30,60");
    same("albedo -m " + m + " --wavelengths 0.5 --theta-i 30,60",
         "albedo " + m + " --wavelengths 0.5 --theta-i 30 60");
    same("polar -m " + m + " --wavelength 0.5 --theta-i 30", "polar " + m + " --wavelengths 0.5 --theta 30");
    for (const std::string count : {"--samples", "--pairs", "--count"})
        same("sample -m " + m + " --wavelength 2 --theta-i 45 --count 5",
             "sample " + m + " --wavelengths 2 --theta 45 " + count + " 5");
    same("spectrum -m " + m + " --wavelengths 0.5,0.6 --theta-i 30 --theta-r 40 --phi 170",
         "spectrum " + m + " --wavelength 0.5,0.6 --theta 30 --theta-r 40 --phi 170");
    same("table export " + m + " --format csv --wavelengths 0.5 --pairs 50 --json -o a.csv",
         "table export -m " + m + " --format csv --wavelength 0.5 --samples 50 --json -o a.csv");
    same("compare curet-sandpaper -m " HTS_SOURCE_DIR
         "/cli/data/sandpaper.json --cone-rings 1 --band-nodes 1",
         "compare curet-sandpaper " HTS_SOURCE_DIR "/cli/data/sandpaper.json --rings 1 --band-nodes 1");
    CHECK(place.hts("eval " + m + " --wavelengths 0.5 --pairs 10").exit_code == 0);
    CHECK(place.hts("render sphere " HTS_SOURCE_DIR "/cli/data/satin.json --size 16 --count 1 -o a.png")
              .exit_code == 0);
}

TEST_CASE("completion: bash offers verbs, options and the words that an option takes") {
    const Workplace place;
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        const auto script = place.hts("completion " + shell);
        CHECK(script.exit_code == 0);
        for (const std::string word : {"lookup", "theta-i", "klems", "kurt13", "tolerance"})
            CHECK(script.output.find(word) != std::string::npos);
    }
    place.file("hts.bash", place.hts("completion bash").output);
    const auto offered = [&](const std::string& words) {
        place.file("ask",
                   "set -u; source ./hts.bash; COMP_WORDS=(" + words +
                       "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _hts; printf '%s\\n' \"${COMPREPLY[@]}\"");
        const std::string command = "cd '" + place.folder().string() + "' && bash ./ask > answer 2>&1";
        CHECK(std::system(command.c_str()) == 0);
        return lines_of(place.read("answer"));
    };
    using Words = std::vector<std::string>;
    CHECK(offered("hts sp") == Words{"spectrum"});
    CHECK(offered("hts table lo") == Words{"lookup"});
    CHECK(offered("hts table build --tol") == Words{"--tolerance"});
    CHECK(offered("hts table export m.json --format r") == Words{"rgl", "radiance"});
    CHECK(offered("hts render fig") == Words{"fig12", "fig13", "fig14"});
    CHECK(offered("hts eval --points h") == Words{"hts.bash"});
    CHECK(offered("hts fit blue") == Words{"blue-acrylic"});
}
