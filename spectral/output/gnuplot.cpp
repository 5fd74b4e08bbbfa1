#include "spectral/output/gnuplot.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "hts/error.hpp"
#include "spectral/output/program.hpp"
#include "spectral/output/script.hpp"
#include "spectral/output/svg.hpp"
#include "spectral/text/output.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"

namespace hts::output {
namespace {

namespace fs = std::filesystem;

std::string one_line(std::string text) {
    for (char& c : text) c = c == '\n' || c == '\t' ? ' ' : c;
    const auto first = text.find_first_not_of(" ^");
    return first == std::string::npos ? "no message" : text.substr(first, 300);
}

/// gnuplot ends well even where the medium was full.
bool is_whole(const fs::path& svg) {
    constexpr std::string_view end = "</svg>";
    std::ifstream file{svg, std::ios::binary | std::ios::ate};
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
    std::string tail(static_cast<std::size_t>(std::min<std::streamoff>(size, 64)), '\0');
    file.seekg(size - static_cast<std::streamoff>(tail.size()));
    file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    return tail.find(end) != std::string::npos;
}

/// Whether the medium took all of the finished picture.
bool finish(const fs::path& svg) {
    std::ostringstream text;
    text << std::ifstream{svg, std::ios::binary}.rdbuf();
    std::ofstream file{svg, std::ios::binary | std::ios::trunc};
    file << finished_svg(text.str());
    file.close();
    return static_cast<bool>(file);
}

std::string head(const std::string& picture) {
    return "# run `gnuplot` on this file, in its folder, to draw it again\n"
           "if (!exists('picture')) picture = " +
           gnuplot_string(gnuplot_file(picture)) +
           "\n"
           "set encoding utf8\n"
           "set terminal svg size 900,600 font 'Helvetica,15' background '#ffffff'\n"
           "set output picture\n" +
           std::string{script_file("style")};
}

}  // namespace

void require_gnuplot(const std::string& svg_path) {
    const char* const path = std::getenv("PATH");
    const auto folders = spectral::split(path != nullptr ? path : "/bin:/usr/bin", ':');
    const auto holds_gnuplot = [](std::string_view folder) {
        return ::access((fs::path{folder} / "gnuplot").c_str(), X_OK) == 0;
    };
    if (std::ranges::none_of(folders, holds_gnuplot))
        throw Error{svg_path + ": gnuplot not found: must be installed to draw (apt install gnuplot-nox)"};
}

void draw(const std::string& svg_path, std::string_view script) {
    require_gnuplot(svg_path);
    const fs::path svg{svg_path};
    const fs::path script_path = fs::path{svg}.replace_extension(".gnuplot");
    const std::string name = svg.filename().string();
    spectral::write_file(script_path.string(), head(name) + std::string{script});

    std::optional<spectral::RunFiles> own;
    auto* files = spectral::RunFiles::of_process();
    if (files == nullptr) files = &own.emplace();
    const fs::path picture{files->open(svg_path)};
    // Numbers of the same run stand where the picture is made, others one folder up. The picture's own name
    // may be one that gnuplot cannot write.
    const fs::path drawn = picture.parent_path() / ".picture.svg";
    const spectral::Unfinished unfinished{drawn.string(), spectral::Unfinished::Kind::file};
    const Ended ended = run_program({"gnuplot", "-e", "set loadpath '..'; picture = '.picture.svg'",
                                     fs::absolute(spectral::path_to_read(script_path)).string()},
                                    {.folder = picture.parent_path().string()});
    std::error_code failure;
    if (ended.status == 0 && is_whole(drawn) && finish(drawn)) fs::rename(drawn, picture, failure);
    if (ended.status == 0 && !failure && fs::exists(picture)) {
        files->complete(svg_path);
        if (own) own->commit();
        return;
    }
    fs::remove(drawn, failure);
    files->drop(svg_path);
    throw Error{svg_path + ": gnuplot failed: " + one_line(ended.output)};
}

}  // namespace hts::output
