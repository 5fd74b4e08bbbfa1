// No output may be an input or another output; whether outputs can be written is known before the work; all
// outputs of a run appear or none; files keep their mode and links lead where they led.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "command.hpp"

namespace {

namespace fs = std::filesystem;
using namespace hts::cli::testing;

#ifndef __has_feature
#define __has_feature(x) false
#endif
/// 4 GB for a command, and some time. The address sanitizer reserves terabytes of addresses; it limits what
/// is used of them.
constexpr const char* little_memory = __has_feature(address_sanitizer)
                                          ? "ASAN_OPTIONS=$ASAN_OPTIONS:hard_rss_limit_mb=4000 timeout 60"
                                          : "ulimit -v 4000000; timeout 20";

const std::string aluminium = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";
const std::string pair = " --theta-i 30 --theta-r 40 --phi 180";

mode_t mode_of(const fs::path& path) {
    struct stat status {};
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

/// A place with inputs of every kind, all of which are to stay as they are.
struct Inputs {
    Workplace place;
    std::vector<std::pair<std::string, std::string>> files;

    Inputs() {
        add("m.json", R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
                          "index": {"file": "nk.csv"}})");
        add("nk.csv", "wavelength_um,n,k\n0.4,0.5,5\n0.7,1.5,7\n");
        add("s.json",
            R"({"materials": ["m.json"], "wavelengths_um": [0.5], "tolerance": {"relative_brdf_error": )"
            R"(0.1}})");
        add("p.csv", "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.5,30,0,40,180\n");
        add("gt.csv", "g,t\n1,2\n");
        fs::create_symlink("m.json", place.folder() / "link.json");
        fs::create_hard_link(place.folder() / "m.json", place.folder() / "twin.json");
        fs::create_directory(place.folder() / "sub");
    }
    void add(const std::string& name, const std::string& text) {
        files.emplace_back(place.file(name, text), text);
    }
    void check_untouched() const {
        for (const auto& [name, text] : files) CHECK(place.read(name) == text);
        CHECK(place.names() == std::vector<std::string>{"gt.csv", "link.json", "m.json", "nk.csv", "p.csv",
                                                        "s.json", "sub", "twin.json"});
        CHECK(fs::is_empty(place.folder() / "sub"));
    }
};

}  // namespace

TEST_CASE("an output is no input, by whatever name") {
    const Inputs inputs;
    for (const std::string& command : std::vector<std::string>{
             "eval -m m.json --wavelength 0.5" + pair + " -o m.json",
             "eval -m m.json --wavelength 0.5" + pair + " -o ./sub/../m.json",
             "eval -m m.json --wavelength 0.5" + pair + " -o link.json",
             "eval -m link.json --wavelength 0.5" + pair + " -o m.json",
             "eval -m m.json --wavelength 0.5" + pair + " -o twin.json",
             "eval -m m.json --wavelength 0.5" + pair + " -o $PWD/m.json",
             "eval -m m.json --wavelength 0.5" + pair + " -o nk.csv",  // which m.json names
             "eval -m m.json --points p.csv -o p.csv",
             "phi --points gt.csv -o gt.csv",
             "plan s.json -o s.json",
             "plan s.json -o m.json",
             "table export m.json --format csv -o m",  // m.json is its sidecar
             "table export m.json --format csv -o m.json",
             "table import p.csv -o p.csv",
             "table import m.json --csv m.json",
             "table build -m m.json --wavelengths 0.5 --tolerance 0.1 -o m.json",
             "table chart -m m.json --wavelengths 0.5 -o m.json",
             "info m.json -o m.json",
             "info m.json --wavelengths 0.5 -o nk.csv",
             "albedo -m m.json --wavelengths 0.5 -o m.json",
             "spectrum -m m.json" + pair + " -o nk.csv",
             "polar -m m.json --wavelength 0.5 --theta-i 30 -o nk.svg",  // nk.csv holds its numbers
             "sample -m m.json --wavelength 0.5 --theta-i 30 -o m.json",
             "materials nk.csv -o nk.csv",
             "curves show s.json -o s.json",
             "curves import p.csv --recipe s.json -o s.json",
             "fit s.json -o s.json",
             "fit s.json --report s.json",
         }) {
        INFO(command);
        check_complaint(inputs.place.hts(command), 2, {": an output must be another file"});
        inputs.check_untouched();
    }
}

TEST_CASE("an output is no input where a shell opens either of them") {
    const Inputs inputs;
    check_complaint(inputs.place.hts("eval m.json --points - -o p.csv < p.csv"), 2,
                    {"p.csv: is the same file as the input standard input: an output must be another file"});
    for (const std::string command : {"phi --points gt.csv", "phi --points - < gt.csv"}) {
        static_cast<void>(inputs.place.hts(command + " >> gt.csv 2> ../said; true"));
        INFO(command);
        CHECK(inputs.place.read("../said").find("hts: standard output: is the same file as the input ") == 0);
    }
    check_complaint(inputs.place.hts("table import - --wavelengths 0.5 -o twin.json < m.json"), 2,
                    {"twin.json: is the same file as the input /dev/stdin"});
    inputs.check_untouched();
    CHECK(inputs.place.hts("phi --points - < gt.csv").exit_code == 0);
}

TEST_CASE("an output is no other output, by whatever name") {
    const Inputs inputs;
    const std::string of = "spectrum -m m.json --wavelengths 0.5,0.6" + pair;
    for (const std::string& command : std::vector<std::string>{
             of + " --plot x.svg -o x.svg",
             of + " --plot x.svg -o x.gnuplot",
             of + " --plot x.svg -o sub/../x.svg",
             "fit blue-acrylic -o a.json --report a.json",
             "fit blue-acrylic -o a.json --report ./a.json",
             "table import p.csv -o a.json --csv a.json",
             "sample -m m.json --wavelength 0.5 --theta-i 30 --plot a.svg -o a.svg",
             "table chart -m m.json --wavelengths 0.5 --plot a.svg -o a.gnuplot",
         }) {
        INFO(command);
        check_complaint(inputs.place.hts(command), 2, {": two outputs go to this file"});
        inputs.check_untouched();
    }
    // not a file: both may go there
    CHECK(inputs.place.hts("table import p.csv -o /dev/null --csv /dev/null").exit_code != 2);
}

TEST_CASE("whether outputs can be written is known before the work") {
    const Inputs inputs;
    // each of these works for minutes or hours
    for (const std::string& command : std::vector<std::string>{
             "table chart -m m.json --wavelengths 0.4:0.7:31 --samples 1000000 -o none/x.csv",
             "table chart -m m.json --wavelengths 0.4:0.7:31 --samples 1000000 -o x.csv --plot none/x.svg",
             "table build -m m.json --wavelengths 0.4:0.7:31 --tolerance 1e-7 -o none/x",
             "fit blue-acrylic --starts 512 -o x.json --report none/x.json",
             "fit --all-models blue-acrylic --starts 512 -o none/x.json",
             "sample -m m.json --wavelength 0.5 --theta-i 30 --count 1000000000 -o x.csv --plot none/x.svg",
             "render fig14 --size 4096 --samples 65536 -o none/x.png",
             "figures kurt -o m.json",
             "truth moments -o m.json/x",
             "validate -o m.json",
             "chart -o m.json",
             "furnace -o m.json",
             "stability -o m.json",
         }) {
        INFO(command);
        check_complaint(inputs.place.hts(command, "timeout 20"), 1, {": cannot be "});
        inputs.check_untouched();
    }
}

TEST_CASE("all outputs of a run or none, folders too") {
    const Inputs inputs;
    const Workplace& place = inputs.place;
    const std::string of = "spectrum -m m.json --wavelengths 0.5,0.6" + pair;
    // a gnuplot that fails once everything else is done
    const std::string tools = (place.folder().parent_path() / "tools").string();
    fs::create_directory(tools);
    place.file("../tools/gnuplot", "#!/bin/sh\necho broken >&2\nexit 1\n");
    fs::permissions(tools + "/gnuplot", fs::perms::owner_all);
    for (const std::string& command : std::vector<std::string>{
             of + " -o x.csv --plot x.svg", "polar -m m.json --wavelength 0.5 --theta-i 30 -o new.svg",
             "furnace --quick -o new/folder"}) {
        INFO(command);
        const auto result = place.hts(command, "PATH=" + tools + ":$PATH");
        CHECK(result.exit_code == 1);
        CHECK(result.errors.find("gnuplot failed: broken") != std::string::npos);
        inputs.check_untouched();
    }
    CHECK(place.hts("stability -o new/folder > /dev/full #").exit_code == 1);
    inputs.check_untouched();
}

TEST_CASE("a picture that is cut off is no picture") {
    const Inputs inputs;
    const auto result = inputs.place.hts(
        "sample -m m.json --wavelength 0.5 --theta-i 30 --count 1000 -o /dev/null --plot x.svg",
        "ulimit -f 100;");
    CHECK(result.exit_code == 1);
    CHECK(result.errors.find("x.svg: ") != std::string::npos);
    inputs.check_untouched();
}

TEST_CASE("files keep their mode, those that nobody may write are refused") {
    const Workplace place;
    place.file("a.csv", "old");
    const fs::path a = place.folder() / "a.csv";
    for (const mode_t mode : {0600U, 0640U, 0666U}) {
        REQUIRE(::chmod(a.c_str(), mode) == 0);
        CHECK(place.hts("phi --g 1 --t 1 -o a.csv").exit_code == 0);
        CHECK(mode_of(a) == mode);
        CHECK(place.read("a.csv").starts_with("g,t,phi"));
    }
    CHECK(place.hts("phi --g 1 --t 1 -o new.csv", "umask 027;").exit_code == 0);
    CHECK(mode_of(place.folder() / "new.csv") == 0640);
    place.file("a.csv", "old");
    REQUIRE(::chmod(a.c_str(), 0444) == 0);
    check_complaint(place.hts("phi --g 1 --t 1 -o a.csv"), 1, {"a.csv: cannot be written"});
    CHECK(place.read("a.csv") == "old");
    CHECK(mode_of(a) == 0444);
}

TEST_CASE("links are written through") {
    const Workplace place;
    const fs::path folder = place.folder();
    fs::create_directory(folder / "d");
    fs::create_symlink("d/a.csv", folder / "dangling");
    fs::create_symlink("dangling", folder / "chain");
    CHECK(place.hts("phi --g 1 --t 1 -o chain").exit_code == 0);
    CHECK(fs::is_symlink(folder / "dangling"));
    CHECK(place.read("d/a.csv").starts_with("g,t,phi"));
    fs::create_hard_link(folder / "d/a.csv", folder / "twin");
    CHECK(place.hts("phi --g 2 --t 1 -o twin").exit_code == 0);
    CHECK(place.read("d/a.csv").find("\n2,1,") != std::string::npos);
    fs::create_symlink("none/a.csv", folder / "lost");
    check_complaint(place.hts("phi --g 1 --t 1 -o lost"), 1, {"lost: cannot be written"});
    fs::create_symlink("loop", folder / "loop");
    check_complaint(place.hts("phi --g 1 --t 1 -o loop"), 1, {"loop: cannot be written"});
    CHECK(place.hts("phi --g 1 --t 1 -o /dev/stdout").output.starts_with("g,t,phi"));
    CHECK(place.names() == std::vector<std::string>{"chain", "d", "dangling", "loop", "lost", "twin"});
}

TEST_CASE("any name that the system takes can be written") {
    const Inputs inputs;
    const Workplace& place = inputs.place;
    const std::string longest(255, 'x');
    CHECK(place.hts("phi --g 1 --t 1 -o " + longest).exit_code == 0);
    CHECK(fs::remove(place.folder() / longest));
    for (const std::string& stem :
         std::vector<std::string>{std::string(247, 'x'), std::string{"-e"}, std::string{"-"},
                                  std::string{"|touch evil"}, std::string{"<touch evil"},
                                  std::string{"a b'c\"d"}, std::string{"two\nlines"}, std::string{"λ"}}) {
        INFO(stem);
        std::string quoted = stem;
        for (std::size_t at = 0; (at = quoted.find('\'', at)) != std::string::npos; at += 4)
            quoted.replace(at, 1, "'\\''");
        CHECK(place.hts("polar -m m.json --wavelength 0.5 --theta-i 30 '--output=" + quoted + ".svg'")
                  .exit_code == 0);
        CHECK(place.read(stem + ".svg").find("</svg>") != std::string::npos);
        for (const std::string end : {".svg", ".csv", ".gnuplot"})
            CHECK(fs::remove(place.folder() / (stem + end)));
        inputs.check_untouched();
    }
}

TEST_CASE("what cannot be read ends with a message that says why") {
    const Workplace place;
    check_complaint(place.hts("phi --points - <&-"), 1, {"<stdin>: cannot be read: Bad file descriptor"});
    check_complaint(place.hts("table import - <&-"), 1, {"<stdin>: cannot be read: Bad file descriptor"});
    check_complaint(place.hts("phi --points - < ."), 1, {"<stdin>: cannot be read: Is a directory"});
    place.file("zero.json", R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
                                "index": {"file": "/dev/zero"}})");
    check_complaint(place.hts("eval -m zero.json --wavelength 0.5" + pair, little_memory), 1,
                    {"/dev/zero", "not UTF-8 text"});
    check_complaint(place.hts("eval -m /dev/zero --wavelength 0.5" + pair, little_memory), 1, {"/dev/zero"});
    check_complaint(place.hts("phi --points /dev/zero", little_memory), 1, {"/dev/zero:1: not UTF-8 text"});
    place.file("image.json", R"({"model": "ashikhmin", "f0": 0.9,
                                 "normals": {"type": "image", "file": "/dev/zero", "extent": 1,
                                             "sigma_x": 0.1, "sigma_y": 0.1}})");
    check_complaint(place.hts("eval -m image.json --wavelength 0.5" + pair, little_memory), 1,
                    {"/dev/zero", "PNG"});
    // standard output is closed: no file of the run takes its place
    CHECK(place.hts("phi --g 1 --t 1 -o a.csv 2> ../errors >&- #").exit_code == 0);
    CHECK(place.read("a.csv").starts_with("g,t,phi"));
    CHECK(place.hts("phi --g 1 --t 1 2> ../errors >&- #").exit_code == 1);
}

TEST_CASE("slices of another kind are not thrown away, and a table is as small as was asked for") {
    const Workplace place;
    const std::string build = "table build -m " + aluminium + " --wavelengths 0.5 --tolerance 0.3 --output t";
    place.file("t.slices", "my own notes");
    check_complaint(place.hts(build), 1, {"t.slices: no finished slices", "must be removed first"});
    CHECK(place.read("t.slices") == "my own notes");
    fs::remove(place.folder() / "t.slices");
    check_complaint(place.hts(build + " --largest-bytes 1024"), 1, {"1024 bytes"});
    CHECK(place.names().empty());
    CHECK(place.hts(build).exit_code == 0);
    CHECK(place.names() == std::vector<std::string>{"t"});
}
