// Every option of every verb with what it does not take: one line that names it, exit code 2, nothing left
// behind.

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "command.hpp"

using hts::cli::testing::check_complaint;
using hts::cli::testing::Workplace;

namespace {

constexpr int wrong_usage = 2;

/// @pair, @point and @fit in the arguments stand for legal options.
struct Case {
    const char *arguments, *named;
};

constexpr std::array cases{
    Case{"", "verb missing"},
    Case{"rendr", "unknown verb \"rendr\": must be one of eval, "},
    Case{"--verbose", "subcommand"},

    Case{"eval", "--points"},
    Case{"eval @point", "--material"},
    Case{"eval m.json p.json @point", "p.json"},
    Case{"eval --material m.json --wavelength '' @pair", "--wavelength: \"\": must not be empty"},
    Case{"eval --material '' @point", "--material: \"\": must not be empty"},
    Case{"eval --material m.json --wavelength 0.5 --theta-i '' --theta-r 40 --phi 0", "--theta-i: \"\""},
    Case{"eval --material m.json --wavelength 0.5 --theta-i= --theta-r 40 --phi 0", "--theta-i: \"\""},
    Case{"eval --material m.json --wavelength 0.5 --theta-i ' ' --theta-r 40 --phi 0", "--theta-i: \" \""},
    Case{"eval --material m.json --wavelengths '' @pair", "--wavelengths: \"\""},
    Case{"eval --material m.json --wavelength 0.5 --theta_i 30 --theta-r 40 --phi 0",
         "unknown option \"--theta_i\"; did you mean \"--theta-i\"?"},
    Case{"eval --materail m.json @point", "did you mean \"--material\"?"},
    Case{"eval --material m.json --wavelength 0.5 --thetai=30 --theta-r 40 --phi 0", "\"--theta-i\""},
    Case{"sample --materiel m.json --wavelength 0.5", "did you mean \"--material\"?"},
    Case{"sampel", "did you mean \"sample\"?"},
    Case{"table lokup", "did you mean \"lookup\"?"},
    Case{"help sampel", "did you mean \"sample\"?"},
    Case{"help table lokup", "did you mean \"lookup\"?"},
    Case{"eval --materiel m.json @point", "--materiel"},
    Case{"eval --material", "--material: must have a value (see hts eval --help)"},
    Case{"eval m.json --wavelength", "--wavelength: must have a value"},
    Case{"eval m.json --wavelength 0.5 --wavelength 0.6 @pair", "--wavelength: given more than once"},
    Case{"eval m.json --material p.json @point", "--material: given more than once: must be given once"},
    Case{"eval --material m.json --wavelength 0.5 --theta-i 30 --phi 170", "--theta-r"},
    Case{"eval --material m.json --wavelength 0.5 --theta-i 95 --theta-r 40 --phi 170", "95 deg: must be"},
    Case{"eval --material m.json --wavelength 0.5 --theta-i nan --theta-r 40 --phi 170", "nan deg: must be"},
    Case{"eval --material m.json --wavelength 0.5 --theta-i 30 --theta-r 40 --phi inf", "inf"},
    Case{"eval --material m.json @point --phi-r 20", "--phi"},
    Case{"eval --material m.json --wavelength -1 @pair", "-1 um: must be > 0"},
    Case{"eval --material m.json --wavelength nan @pair", "nan um: must be > 0"},
    Case{"eval --material m.json --wavelength green @pair", "green"},
    Case{"eval --material m.json --wavelengths 0.7:0.4:3 @pair", "0.7"},
    Case{"eval --material m.json --wavelengths 0.4:0.7:0 @pair", "--wavelengths"},
    Case{"eval --material m.json --wavelengths 0.4:0.7:1e12 @pair", "--wavelengths"},
    Case{"eval --material m.json --wavelengths red,green @pair", "red"},
    Case{"eval --material m.json --wavelengths 0.4,0.5 @point", "both given"},
    Case{"eval --material m.json --points p.csv @point", "both given"},
    Case{"eval --material m.json @point --polarisation x", "--polarisation"},
    Case{"eval --material m.json @point --polarisation 1,2", "must be s, p, unpolarised or s0,s1,s2,s3"},
    Case{"eval --material m.json @point --polarisation 1,2,0,0", "--polarisation"},
    Case{"eval --material satin.json @point --mueller", "model he"},
    Case{"eval --material m.json @point --transmission --mueller", "--transmission"},
    Case{"eval --material m.json @point --output ''", "--output: \"\""},
    Case{"eval --material m.json --wavelengths 0.4,0.5 --random-pairs 0", "from 1 to 1000000000"},
    Case{"eval --material m.json --wavelengths 0.4,0.5 --random-pairs -3", "\"-3\""},
    Case{"eval --material m.json --wavelengths 0.4,0.5 --random-pairs 1.5", "\"1.5\""},
    Case{"eval --material m.json --wavelengths 0.4,0.5 --random-pairs 99999999999999999999", "whole number"},
    Case{"eval --material m.json --wavelengths 0.4,0.5 --random-pairs 9 --seed -1", "--seed"},
    Case{"eval --material m.json --wavelengths 0.4,0.5 --random-pairs 9 --mueller", "both given"},
    Case{"eval --material m.json --random-pairs 9", "--wavelengths"},
    Case{"eval --plan plan.json @point", "--plan"},
    Case{"eval --material m.json @point --tolerance 1e-13",
         "--tolerance: \"1e-13\": must be a number from 1e-12 to 1"},
    Case{"eval --material m.json @point --tolerance 1e-6 --detail", "--detail and --tolerance both given"},

    Case{"phi", "--g"},
    Case{"phi --g 1", "--t"},
    Case{"phi --g -1 --t 2", "-1"},
    Case{"phi --g nan --t 1", "nan"},
    Case{"phi --g 1e301 --t 1", "1e+301"},
    Case{"phi --g 1 --t inf", "inf"},
    Case{"phi --g 1 --t 1 --points gt.csv", "--points"},

    Case{"spectrum --material m.json --theta-i 30", "--theta-r"},
    Case{"spectrum --material m.json @pair --illuminant X", "--illuminant"},
    Case{"spectrum --material m.json @pair --wavelengths 0.4:0.4:5", "--wavelengths"},
    Case{"spectrum --material m.json @pair --tolerance 2", "--tolerance: \"2\""},
    Case{"spectrum --material m.json @pair --plot -", "--plot: \"-\": must be a file .svg"},

    Case{"polar --material m.json --wavelength 0.5", "--theta-i"},
    Case{"polar --material m.json --theta-i 30 --wavelength 0", "0 um: must be > 0"},
    Case{"polar --material m.json --theta-i 10,x --wavelength 0.5", "x"},
    Case{"polar --material m.json --theta-i nan --wavelength 0.5", "nan deg"},
    Case{"polar --material m.json --theta-i 10 --wavelength 0.5 --phi-i nan", "--phi-i"},
    Case{"polar --material m.json --theta-i 10 --wavelength 0.5 --solid-angle 0", "--solid-angle"},
    Case{"polar --material m.json --theta-i 10 --wavelength 0.5 --solid-angle nan", "--solid-angle"},
    Case{"polar --material m.json --theta-i 10 --wavelength 0.5 --json --output a.svg", "--json"},

    Case{"albedo", "--material"},
    Case{"albedo --material m.json --theta-i 10,,45", "--theta-i: \"\" is not a number"},
    Case{"albedo --material m.json --theta-i 10,45,", "--theta-i: \"\" is not a number"},
    Case{"albedo --material m.json --theta-i ,10", "--theta-i: \"\" is not a number"},
    Case{"albedo --material m.json --theta-i ''", "--theta-i: \"\": must not be empty"},
    Case{"albedo --material m.json --wavelengths 0.4,,0.5", "--wavelengths"},
    Case{"albedo --material m.json --steepest ''", "--steepest: \"\""},
    Case{"albedo --material m.json --theta-i 30,95", "95 deg: must be from 0 to 90 deg"},
    Case{"albedo --material m.json --theta-i 0 --phi-i nan", "--phi-i"},
    Case{"albedo --material m.json --steepest -1", "--steepest"},
    Case{"albedo --material m.json --measured 0.9", "one wavelength"},
    Case{"albedo --material m.json --wavelengths 0.5 --theta-i 0 --measured nan", "a number from 0 to 1"},
    Case{"albedo --material m.json --wavelengths 0.5 --theta-i 0 --measured 1.2", "\"1.2\""},
    Case{"albedo --material satin.json --wavelengths 0.5 --theta-i 0 --measured 0.5", "model he"},
    Case{"albedo --material satin.json --compensate-energy", "model he"},

    Case{"furnace --quick", "--output"},
    Case{"furnace --quick --output ''", "--output"},

    Case{"sample --material m.json --wavelength nan --theta-i 45", "nan um"},
    Case{"sample --material m.json --wavelength 0.5 --theta-i 45 --count 1.5", "from 1 to 1000000000"},
    Case{"sample --material m.json --wavelength 0.5 --theta-i 45 --count ten", "\"ten\""},
    Case{"sample --material m.json --wavelength 0.5 --theta-i 45 --seed 1e3", "--seed"},

    Case{"plan", "scene"},
    Case{"plan scene.json --seed -1", "--seed"},
    Case{"plan scene.json --pairs 0", "from 1 to 10000000"},
    Case{"plan scene.json --tables", "--tables: must come with --output"},
    Case{"plan scene.json --tables --output -", "--tables: must come with --output"},
    Case{"plan --check p.json --tables", "--check: must not come with --tolerance, --output or --tables"},

    Case{"materials unobtainium", "Al-McPeak"},
    Case{"materials al", "did you mean \"Al\"?"},
    Case{"materials --wavelengths 0.5", "name"},
    Case{"materials Al --wavelengths x", "--wavelengths"},

    Case{"info", "material"},
    Case{"info m.json extra", "extra"},
    Case{"info m.json --theta 10,,45", "--theta-i: \"\" is not a number"},
    Case{"info m.json --theta 0,91", "91 deg: must be from 0 to 90 deg"},
    Case{"info m.json --wavelengths nan", "--wavelengths"},

    Case{"figures", "paper"},
    Case{"figures shakespeare --output x", "shakespeare"},
    Case{"figures he91 --output x", "did you mean \"he1991\"?"},
    Case{"figures he1991", "--output"},
    Case{"figures he1991 --output ''", "--output"},

    Case{"curves", "verb missing: must be one of import, list, show (see hts curves --help)"},
    Case{"curves lost", "unknown verb \"lost\""},
    Case{"curves show", "set"},
    Case{"curves show lost-set", "no curve set \"lost-set\": must be a file or one of anodised-ec1"},
    Case{"curves import p.csv", "--recipe"},
    Case{"curves import p.csv --recipe m.json --every 0", "from 1 to 1000"},

    Case{"fit", "curves"},
    Case{"fit lost-set", "no curve set"},
    Case{"fit blue-acrylic anodised-ec1", "must be one set"},
    Case{"fit blue-acrilic", "did you mean \"blue-acrylic\"?"},
    Case{"fit blue-acrylic --model becmann", "did you mean \"beckmann\"?"},
    Case{"fit blue-acrylic --loss huver", "did you mean \"huber\"?"},
    Case{"fit blue-acrylic --free scale,,k", "--free: \"\": must not be empty"},
    Case{"fit blue-acrylic --model gloss", "must be one of he, he_unified, beckmann"},
    Case{"fit blue-acrylic --model kurt --lobes 4", "from 1 to 3"},
    Case{"fit blue-acrylic --model kurt --lobes -1", "from 1 to 3"},
    Case{"fit blue-acrylic --lobes 2", "has no lobes"},
    Case{"fit blue-acrylic --model kurt --index Al", "has no index"},
    Case{"fit blue-acrylic --index unobtainium", "Al-McPeak"},
    Case{"fit blue-acrylic --index '{\"n\":'", "fit: index:1"},
    Case{"fit blue-acrylic --index '{\"n\": -1, \"k\": 0}'", "index.n"},
    Case{"fit blue-acrylic --index Al --fix index=Cu", "--index"},
    Case{"fit blue-acrylic --index PMMA --free k", "\"k\": must not be asked for where the index is given"},
    Case{"fit blue-acrylic --fix sigma0", "name=value"},
    Case{"fit blue-acrylic --fix a=", "--fix"},
    Case{"fit blue-acrylic --fix a=2", "a: fixed at 2: must be 0 ... 1"},
    Case{"fit blue-acrylic --fix gloss=1", "parameter \"gloss\""},
    Case{"fit blue-acrylic --fix a=0 --free a", "freed and fixed"},
    Case{"fit blue-acrylic --free my", "parameter \"my\" of model \"he\""},
    Case{"fit blue-acrylic --start sigma0=1e9", "sigma0: start 1e+09 um: must be 1e-04 ... 1000 um"},
    Case{"fit blue-acrylic --residual square", "must be one of log"},
    Case{"fit blue-acrylic --loss sums", "must be one of squares"},
    Case{"fit blue-acrylic --loss huber --loss-scale 0", "--loss-scale"},
    Case{"fit blue-acrylic --loss huber --loss-scale nan", "--loss-scale"},
    Case{"fit blue-acrylic --largest-theta 91", "a number from 0 to 90"},
    Case{"fit blue-acrylic --largest-theta nan", "a number from 0 to 90"},
    Case{"fit blue-acrylic --most-points -1", "--most-points"},
    Case{"fit blue-acrylic --rings 9", "from 0 to 8"},
    Case{"fit blue-acrylic --starts 0", "from 1 to 512"},
    Case{"fit blue-acrylic --all-models --model kurt", "--all-models"},
    Case{"fit blue-acrylic --all-models --index unobtainium", "Al-McPeak"},
    Case{"fit blue-acrylic --all-models --report r.json", "--all-models"},

    Case{"compare blue-acrylic", "--material"},
    Case{"compare lost-set --material m.json", "no curve set"},
    Case{"compare blue-acrylic --material m.json --source-solid-angle -1", "solid-angle"},
    Case{"compare blue-acrylic --material m.json --detector-solid-angle nan", "solid-angle"},
    Case{"compare blue-acrylic --material m.json --band-nodes 0", "from 1 to 64"},
    Case{"compare blue-acrylic --material m.json --cone-rings 9", "from 0 to 8"},

    Case{"render", "scene is required"},
    Case{"render fig15 --output x.png", "fig15"},
    Case{"render fig14", "--output"},
    Case{"render fig14 --output x.jpg", ".png"},
    Case{"render fig14 --material m.json --output x.png", "--material"},
    Case{"render fig14 --turn 3 --output x.png", "--turn"},
    Case{"render sphere --output x.png", "--material"},
    Case{"render sphere --material satin.json --turn nan --output x.png", "a number from -360 to 360"},
    Case{"render sphere --material satin.json --exposure nan --output x.png", "a number from 0.001 to 1000"},
    Case{"render sphere --material satin.json --size 8 --output x.png", "from 16 to 4096"},
    Case{"render sphere --material satin.json --samples 0 --output x.png", "from 1 to 65536"},

    Case{"chart --quick", "--output"},
    Case{"chart --quick --output x --seed 1.5", "--seed"},
    Case{"stability --output ''", "--output"},
    Case{"truth moments", "--output"},
    Case{"truth lies --output x", "lies"},
    Case{"truth vector --side 8 --output x", "--side 8 wavelengths: must be from 9 to 60 wavelengths"},
    Case{"truth vector --realisations 2 --output x", "--realisations 2: must be from 10 to 10000"},
    Case{"truth rays --side 20 --output x", "--side and --realisations are of hts truth vector"},
    Case{"validate --quick", "--output"},
    Case{"validate --output x --only nothing", "nothing"},
    Case{"validate --output x --only rays,,fourier", "--only: \"\": must not be empty"},
    Case{"completion tcsh", "must be one of bash, zsh, fish"},
    Case{"validate --output x --curves m.json", "m.json"},

    Case{"table", "verb missing"},
    Case{"table built", "unknown verb \"built\": must be one of build, check"},
    Case{"table build --material m.json", "--output"},
    Case{"table build --material m.json --output t --tolerance 0", "from 1e-09 to 0.5"},
    Case{"table build --material m.json --output t --tolerance nan", "from 1e-09 to 0.5"},
    Case{"table build --material m.json --output t --shard 4/3", "--shard"},
    Case{"table build --material m.json --output t --shard a/b", "--shard"},
    Case{"table build --material m.json --output t --seed -1", "--seed"},
    Case{"table build --material m.json --output t --largest-bytes -1", "--largest-bytes"},
    Case{"table build --material m.json --output t --wavelengths 0.7:0.4:3", "--wavelengths"},
    Case{"table check t --samples 0", "from 1 to 100000000"},
    Case{"table check t --seed -1", "--seed"},
    Case{"table lookup t", "--points"},
    Case{"table merge --output x", "parts"},
    Case{"table export m.json --format xyz --output x", "xyz"},
    Case{"table export m.json --format Merl --output x", "did you mean \"merl\"?"},
    Case{"table export m.json --format merl", "--output"},
    Case{"table export m.json --format merl --output x --specular sphere", "sphere"},
    Case{"table export m.json --format merl --output x --solid-angle 0.1", "--specular"},
    Case{"table export m.json --format csv --output x --specular box --solid-angle nan", "--solid-angle"},
    Case{"table export m.json --format merl --output x --pairs 0", "from 1 to 100000000"},
    Case{"table export m.json --format merl --output x --seed -1", "--seed"},
    Case{"table import p.csv --format xyz", "xyz"},
    Case{"table import p.csv --wavelengths x", "--wavelengths"},
    Case{"table chart --material m.json --samples 0", "from 100 to 1000000"},
    Case{"table chart --material m.json --plot sizes.png", "must be a file .svg"},
};

std::string completed(std::string text) {
    const std::string pair = "--theta-i 30 --theta-r 40 --phi 170";
    for (const auto& [name, meaning] :
         {std::pair{std::string{"@pair"}, pair}, {std::string{"@point"}, "--wavelength 0.5 " + pair}}) {
        if (const auto at = text.find(name); at != std::string::npos) text.replace(at, name.size(), meaning);
    }
    return text;
}

}  // namespace

TEST_CASE("wrong usage") {
    const Workplace place;
    place.file("m.json", R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
                             "index": "Al"})");
    place.file("satin.json", R"({"model": "ward", "lobes": [{"ks": 0.3, "mx": 0.2, "my": 0.4}], "kd": 0.1})");
    for (const Case& one : cases) {
        INFO("hts " << one.arguments);
        check_complaint(place.hts(completed(one.arguments)), wrong_usage, {one.named});
    }
    CHECK(place.names() == std::vector<std::string>{"m.json", "satin.json"});
}

TEST_CASE("a medium that is full, or a place that takes no file: exit code 1, nothing half written") {
    const Workplace place;
    const std::string m = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";
    const std::string full =
        "trap '' XFSZ; ulimit -f 4;";  // files of 2 KiB at most, as a full disk would refuse
    const std::string pair = " --theta-i 30 --theta-r 40 --phi 180";
    const std::vector<std::string> commands{
        "spectrum -m " + m + pair + " --wavelengths 0.4:0.7:400 --output a.csv",
        "polar -m " + m + " --wavelength 0.5 --theta-i 10,45 --output a.csv",
        "sample -m " + m + " --wavelength 2 --theta-i 45 --count 1000 --output a.csv",
        "table export " + m + " --format zemax --wavelengths 0.45,0.55 --pairs 10 --output a.json",
        "table export " + m + " --format csv --wavelengths 0.5 --pairs 10 --output a.csv",
        "render sphere --size 64 --samples 1 --output a.png -m " + m,
        "curves show mwir-brass --output a.csv",
    };
    for (const std::string& command : commands) {
        INFO(command);
        CHECK(place.hts(command, full).exit_code == 1);
        CHECK(place.names().empty());
    }
    for (const std::string path : {"/dev/full", "/none/x", "/dev/null/x"}) {
        INFO(path);
        check_complaint(place.hts("eval -m " + m + " --wavelength 0.5" + pair + " --output " + path), 1,
                        {path, "cannot be written"});
        check_complaint(place.hts("phi --g 1 --t 1 --output " + path), 1, {path});
        check_complaint(place.hts("materials --output " + path), 1, {path});
    }
    // the test's own redirection is cut off by #
    CHECK(place.hts("materials > /dev/full 2> ../errors #").exit_code == 1);
    CHECK(place.hts("--help > /dev/full 2> ../errors #").exit_code == 1);
    CHECK(place.hts("fit --help > /dev/full 2> ../errors #").exit_code == 1);
    CHECK(place.hts("--version > /dev/full 2> ../errors #").exit_code == 1);
    CHECK(
        place.hts("fit curet-sandpaper --model lambert --most-points 10 --rings 0 > /dev/full 2> ../errors #")
            .exit_code == 1);
}

TEST_CASE("files of several parts are written all or none") {
    const Workplace place;
    const std::string m = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";
    std::filesystem::create_directory(place.folder() / "a.csv.json");
    const auto exported =
        place.hts("table export " + m + " --format csv --wavelengths 0.5 --pairs 10 --output a.csv");
    check_complaint(exported, 1, {"a.csv.json: is a directory"});
    for (const std::string& command :
         {"polar -m " + m + " --wavelength 0.5 --theta-i 45 --output p.svg",
          "spectrum -m " + m +
              " --wavelengths 0.5,0.6 --theta-i 30 --theta-r 40 --phi 180 --output s.csv --plot s.svg",
          "sample -m " + m + " --wavelength 2 --theta-i 45 --count 10 --output d.csv --plot d.svg"}) {
        INFO(command);
        check_complaint(place.hts(command, "PATH=/nowhere"), 1, {".svg: gnuplot not found"});
    }
    CHECK(place.names() == std::vector<std::string>{"a.csv.json"});
}

TEST_CASE("a number may have a plus in front") {
    const Workplace place;
    const std::string command =
        "sample -m " HTS_SOURCE_DIR "/cli/data/rough-aluminium.json --wavelength 2 --theta-i 45 --count ";
    const auto plain = place.hts(command + "5"), plus = place.hts(command + "+5");
    CHECK(plus.exit_code == 0);
    CHECK(plus.output == plain.output);
    check_complaint(place.hts(command + "+-5"), wrong_usage, {"\"+-5\""});
}
