/// A table turned into a longer or wider one, row by row on all cores.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "cli/io/summary.hpp"
#include "cli/io/table_writer.hpp"
#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/csv.hpp"

namespace hts::cli {

using spectral::CsvReader;
using spectral::CsvRow;

/// Turns every input row into `each` output rows: the input's cells and what `append` adds. Works on a chunk
/// at a time, so memory does not grow with the table; the output is the same for any number of threads. An
/// unusual way of writing the input goes to standard error.
template <class Value>
class Transform {
  public:
    Transform(CsvReader& input, TableWriter& output, std::size_t each)
        : input_{input}, output_{output}, each_{each} {}

    ///   evaluate   (const CsvRow&, std::span<Value> of size each)   may throw hts::Error; path and line are
    ///              put in front
    ///   append     (TableWriter::Row&, const Value&)
    template <class Evaluate, class Append>
    Summary run(const Evaluate& evaluate, const Append& append) {
        if (const std::string dialect = input_.dialect_in_words(); !dialect.empty())
            std::cerr << "hts: " << input_.where_header() << dialect << '\n';
        const std::size_t rows = std::max<std::size_t>(1, values_per_chunk / each_);
        std::size_t count = 0;
        std::error_code unknown;  // of standard input and the like
        const auto size = std::filesystem::file_size(input_.name(), unknown);
        const spectral::Job job{"", unknown ? 0 : size};
        for (auto chunk = input_.read(rows); !chunk.empty(); chunk = input_.read(rows)) {
            count += chunk.size();
            write(chunk, values(chunk, evaluate), append);
            job.set_done(input_.bytes_read());
        }
        output_.finish();
        return {count, each_, watch_.seconds()};
    }

  private:
    static constexpr std::size_t values_per_chunk = 1 << 15;  // some 30 MB
    static constexpr int rows_at_once = 16;                   // by one thread

    template <class Evaluate>
    std::vector<Value> values(const std::vector<CsvRow>& rows, const Evaluate& evaluate) {
        std::vector<Value> values(rows.size() * each_);
        watch_.start();
        const auto evaluate_row = [&](std::size_t i) {
            try {
                evaluate(rows[i], std::span{values}.subspan(i * each_, each_));
            } catch (const Error& error) {
                throw Error{input_.where(rows[i].line) + error.what()};
            }
        };
        spectral::parallel_for(rows.size(), evaluate_row, rows_at_once);
        watch_.stop();
        return values;
    }

    template <class Append>
    void write(const std::vector<CsvRow>& rows, const std::vector<Value>& values, const Append& append) {
        std::vector<std::string> lines(rows.size());
        const auto write_row = [&](std::size_t i) {
            for (std::size_t j = i * each_; j < (i + 1) * each_; ++j) {
                TableWriter::Row row{output_, lines[i]};
                for (const std::string& field : rows[i].fields) row.field(field);
                append(row, values[j]);
                row.end();
            }
        };
        spectral::parallel_for(rows.size(), write_row, rows_at_once);
        for (const std::string& line : lines) output_.add(line);
    }

    CsvReader& input_;
    TableWriter& output_;
    std::size_t each_;
    Stopwatch watch_;
};

}  // namespace hts::cli
