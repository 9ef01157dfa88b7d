// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_csv_h
#define slipstep_utilities_csv_h

#include <slipstep/utilities/clock.h>
#include <slipstep/utilities/exceptions.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace SlipStep
{
  /// Without blanks, tabs and CR around it.
  std::string_view without_blanks(std::string_view text);

  /// A text file, without its byte-order mark.
  /// @throws InputError if it cannot be read, or is in UTF-16
  std::string read_text(const std::filesystem::path &file);

  /// The cells of a line, without blanks and quotation marks around them.
  /// @param delimiter between cells; ' ': any number of blanks and tabs
  /// @param cells of another line, whose memory is used
  std::vector<std::string_view>
  cells_of(const std::string_view        line,
           const char                    delimiter,
           std::vector<std::string_view> cells = {});

  /// How a table of numbers is written.
  struct CsvFormat
  {
    /// Between cells. 0: tab, semicolon, comma or blanks, the first of them
    /// that the header has. ' ': any number of blanks and tabs.
    char delimiter = '\0';

    /// 0: comma or point, whichever the numbers have; both in one file is an
    /// error.
    char decimal_mark = '\0';

    /// Lines that begin with one of these are no rows.
    std::vector<std::string> comment_marks = {"#"};

    /// Line with the names of the columns, counted from 1; what comes before is
    /// skipped. 0: the first line that is neither blank nor a comment.
    std::size_t header_line = 0;

    /// Without one, columns have numbers only and rows begin at header_line.
    bool has_header = true;

    /// Line with the units of the columns, counted from 1; rows begin below it
    /// and below the header. 0: none.
    std::size_t units_line = 0;

    /// Between groups of three digits, as in 1.234,5; 0: nothing is.
    char thousands_mark = '\0';

    /// Whether an empty cell (or NaN, NA, n/a, null, none, -, --) is read as a
    /// quiet NaN instead of being refused.
    bool may_have_gaps = false;

    /// Whether a last line without a line end is left out: the row that a
    /// killed program was about to write.
    bool may_be_cut = false;
  };



  /// The chosen columns of a text file with rows of numbers, a header line,
  /// blank lines and `# key: value` comments. A byte-order mark, Windows line
  /// ends and quoted cells are accepted; other columns may hold anything.
  class CsvTable
  {
  public:
    /// Read the columns named in @p required and, where present, @p optional.
    ///
    /// @throws InputError naming file:line:column (both counted from 1) if the
    /// file cannot be opened, a required column is absent, a row has another
    /// number of cells than the header, or a cell is not a number
    CsvTable(const std::filesystem::path    &file,
             const std::vector<std::string> &required,
             const std::vector<std::string> &optional = {},
             const CsvFormat                &format   = {});

    /// Read the header only, so that columns can be chosen by looking at it.
    CsvTable(const std::filesystem::path &file, const CsvFormat &format);

    /// Read the rows.
    /// @param columns position in the header of each column wanted, by the name
    ///   that it is to have here
    /// @param clock_column the name here of one with times of a clock
    /// @param clock reads them
    void read(const std::map<std::string, std::size_t> &columns,
              const std::string                        &clock_column = "",
              const Clock                              &clock        = Clock());

    /// Of the file.
    std::string name() const
    {
      return file.string();
    }

    /// The names in the header line.
    const std::vector<std::string> &header() const
    {
      return names;
    }

    /// What the line of units has for each column, without brackets; "" where
    /// there is none.
    const std::vector<std::string> &units() const
    {
      return unit_names;
    }

    /// The names in the header for a message: printable, and no longer than
    /// that.
    std::string header_words() const;

    /// What the `# key: value` comments say, keys in lower case.
    const std::map<std::string, std::string> &comments() const
    {
      return comment_values;
    }

    /// What comments say of a key that another one says something else of.
    const std::map<std::string, std::string> &contradicting_comments() const
    {
      return contradictions;
    }

    bool has(const std::string &column) const;

    /// The values of a column that was asked for; empty if the file lacks it.
    const std::vector<double> &operator[](const std::string &column) const;

    /// Number of rows.
    std::size_t size() const
    {
      return begin_of_row.size();
    }

    /// The line in which a row stands, counted from 1.
    std::size_t line(const std::size_t row) const;

    /// Report a value that is a number but makes no sense.
    /// @throws InputError "file:line:column: why"
    [[noreturn]] void reject(const std::size_t  row,
                             const std::string &column,
                             const std::string &why) const;

    /// The same for a cell of the header.
    [[noreturn]] void reject_header(const std::size_t  position,
                                    const std::string &why) const;

  private:
    void read_header();

    void read_units();

    void choose_delimiter(const std::string_view line);

    void read_row(const std::vector<std::string_view> &cells);

    double read_cell(const std::string_view cell, const std::size_t column);

    std::string why_no_number(const std::string_view cell) const;

    /// Find the next line from @p next on that is neither blank nor a comment.
    bool next_line(std::string_view &line);

    void read_comment(const std::string_view line);

    void refuse_other_header(const std::string_view          line,
                             const std::vector<std::string> &first) const;

    /// Where a line begins, counted from 1; the end of the text if it has
    /// fewer.
    const char *begin_of_line(const std::size_t number) const;

    /// What is left of a line from there on.
    std::string_view line_at(const char *const begin) const;

    /// Where the next one begins.
    const char *behind(const std::string_view line) const;

    /// @param place a character of the text
    [[noreturn]] void fail(const char *place, const std::string &why) const;

    std::filesystem::path file;
    CsvFormat             format;

    /// The whole file; shared, since nobody changes it.
    std::shared_ptr<const std::string> text;
    const char                        *next = nullptr;

    std::map<std::string, std::string> comment_values;
    std::map<std::string, std::string> contradictions;
    std::vector<std::string>           names;
    std::vector<std::string>           unit_names;
    std::string_view                   header_text;
    std::size_t                        n_cells = 0;

    /// The columns in the order in which they stand in the file.
    struct Column
    {
      std::string         name;
      std::size_t         position;
      std::vector<double> values;
      bool                has_clock = false;
    };
    Clock                      clock;
    std::vector<Column>        columns;
    std::map<std::string, int> index_of_column;

    /// Kept so that later checks can point at a cell.
    std::vector<const char *> begin_of_row;

    /// Where each mark was met first.
    mutable const char *first_comma = nullptr;
    mutable const char *first_point = nullptr;
  };
} // namespace SlipStep

#endif
