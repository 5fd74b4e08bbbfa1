// hts: reflectance of rough surfaces from physical optics. Exit codes: 0 done, 1 the data or a check failed,
// 2 wrong usage. Data go to standard output, messages to standard error.

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "cli/io/arguments.hpp"
#include "cli/io/help.hpp"
#include "cli/io/progress.hpp"
#include "cli/io/signals.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/correlation/kept_tables.hpp"
#include "hts/version.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/text/run_files.hpp"

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
    hts::cli::add_scatter(program);
    hts::cli::add_surface(program);
    hts::cli::add_truth(program);
    hts::cli::add_validate(program);
    hts::cli::add_completion(program);
}

/// `code`, unless what stands on standard output did not reach it.
int flushed(int code) {
    return std::cout.flush() ? code : fail(data_failed, "standard output: cannot be written");
}

/// After the work: what stands on standard output reaches it, and the outputs get their names.
int finished(hts::spectral::RunFiles& files) {
    if (const int code = flushed(done); code != done) return code;
    try {
        files.commit();
        return done;
    } catch (const hts::Error& error) {
        return fail(data_failed, error.what());
    }
}

void run(CLI::App& program, int argc, char** argv) {
    auto words = hts::cli::command_words(program, argc, argv);
    const hts::spectral::Job job{words.empty() ? "" : words.front(), 1};
    std::ranges::reverse(words);  // as CLI11 takes them
    program.parse(std::move(words));
}

}  // namespace

int main(int argc, char** argv) {
    hts::cli::keep_standard_streams();
    hts::cli::remove_partial_files_on_signals();
    const hts::cli::ProgressWatcher watcher;
    hts::spectral::RunFiles files;
    files.serve_process();
    hts::keep_correlation_tables_in(hts::user_cache_folder());
    CLI::App program{"Reflectance of rough surfaces from physical optics (He, Torrance et al. 1991)", "hts"};
    program.set_version_flag("--version", "hts " HTS_VERSION);
    program.require_subcommand(1);
    program.formatter(std::make_shared<hts::cli::HelpFormatter>());
    program.parse_complete_callback([&files] { files.check(); });
    add_verbs(program);
    program.footer("Each verb explains itself: hts eval --help, or hts help eval");
    hts::cli::require_values(program);
    try {
        run(program, argc, argv);
        return finished(files);
    } catch (const CLI::Success& help_or_version) {
        return flushed(program.exit(help_or_version));
    } catch (const CLI::ParseError& error) {
        return fail(wrong_usage, hts::cli::complaint(program, error));
    } catch (const hts::cli::UsageError& error) {
        return fail(wrong_usage, error.what());
    } catch (const hts::cli::CheckFailed& error) {
        finished(files);
        return fail(data_failed, error.what());
    } catch (const std::bad_alloc&) {
        return fail(data_failed, "memory: not enough for this run; must be asked for less at once");
    } catch (const std::exception& error) {
        return fail(files.conflicted() ? wrong_usage : data_failed, error.what());
    }
}
