// hts: reflectance of rough surfaces from physical optics. Exit codes: 0 done, 1 the data or a check failed,
// 2 wrong usage. Data go to standard output, messages to standard error.

#include <exception>
#include <iostream>
#include <string>

#include "cli/io/signals.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/version.hpp"

namespace {

enum ExitCode { done = 0, data_failed = 1, wrong_usage = 2 };

int fail(ExitCode code, const std::string& message) {
    std::cerr << "hts: " << message << '\n';
    return code;
}

void add_verbs(CLI::App& program) {
    hts::cli::add_eval(program);
    hts::cli::add_phi(program);
    hts::cli::add_spectrum(program);
    hts::cli::add_polar(program);
    hts::cli::add_albedo(program);
    hts::cli::add_furnace(program);
    hts::cli::add_sample(program);
    hts::cli::add_plan(program);
    hts::cli::add_table(program);
    hts::cli::add_materials(program);
    hts::cli::add_info(program);
    hts::cli::add_figures(program);
    hts::cli::add_curves(program);
    hts::cli::add_fit(program);
    hts::cli::add_compare(program);
    hts::cli::add_render(program);
    hts::cli::add_chart(program);
    hts::cli::add_stability(program);
    hts::cli::add_truth(program);
    hts::cli::add_validate(program);
}

/// The word must be an option of `parent` or one of its verbs, which is returned; none if there is nothing to
/// choose.
const CLI::App* known_verb(const CLI::App& parent, const std::string& command, const std::string& word) {
    const auto verbs = parent.get_subcommands([](const CLI::App*) { return true; });
    if (verbs.empty() || word.starts_with('-')) return nullptr;
    std::string names;
    for (const CLI::App* verb : verbs) {
        if (verb->get_name() == word) return verb;
        names += (names.empty() ? "" : ", ") + verb->get_name();
    }
    const std::string problem = word.empty() ? "verb missing" : "unknown verb \"" + word + "\"";
    throw hts::cli::UsageError{problem + ": must be one of " + names + " (see " + command + " --help)"};
}

void require_known_verbs(const CLI::App& program, int argc, char** argv) {
    const CLI::App* parent = &program;
    std::string command = "hts";
    for (int i = 1; parent != nullptr; ++i) {
        const std::string word = i < argc ? argv[i] : "";
        parent = known_verb(*parent, command, word);
        command += " " + word;
    }
}

/// `code`, unless what stands on standard output did not reach it.
int flushed(int code) {
    return std::cout.flush() ? code : fail(data_failed, "standard output: cannot be written");
}

void run(CLI::App& program, int argc, char** argv) {
    require_known_verbs(program, argc, argv);
    program.parse(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
    hts::cli::remove_partial_files_on_signals();
    CLI::App program{"Reflectance of rough surfaces from physical optics (He, Torrance et al. 1991)", "hts"};
    program.set_version_flag("--version", "hts " HTS_VERSION);
    program.require_subcommand(1);
    program.get_formatter()->column_width(34);
    add_verbs(program);
    program.footer("Each verb explains itself: hts eval --help");
    try {
        run(program, argc, argv);
        return flushed(done);
    } catch (const CLI::Success& help_or_version) {
        return flushed(program.exit(help_or_version));
    } catch (const CLI::ParseError& error) {
        return fail(wrong_usage, error.what());
    } catch (const hts::cli::UsageError& error) {
        return fail(wrong_usage, error.what());
    } catch (const std::exception& error) {
        return fail(data_failed, error.what());
    }
}
