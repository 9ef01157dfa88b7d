#ifndef slipstep_utilities_csv_h
#define slipstep_utilities_csv_h

#include <slipstep/utilities/exceptions.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace SlipStep
{
  /// The chosen columns of a comma-separated file with one header line, blank
  /// lines and `# key: value` comments. A byte-order mark and Windows line
  /// ends are accepted; other columns of the file may hold anything.
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
             const std::vector<std::string> &optional = {});

    /// What the `# key: value` comments say, keys in lower case.
    const std::map<std::string, std::string> &comments() const;

    bool has(const std::string &column) const;

    /// The values of a column that was asked for; empty if the file lacks it.
    const std::vector<double> &operator[](const std::string &column) const;

    /// Number of rows.
    std::size_t size() const;

    /// Report a value that is a number but makes no sense.
    /// @throws InputError "file:line:column: why"
    [[noreturn]] void reject(const std::size_t  row,
                             const std::string &column,
                             const std::string &why) const;

  private:
    void read_header(const std::string              &line,
                     const std::vector<std::string> &required,
                     const std::vector<std::string> &optional);

    void read_row(const std::string &line);

    [[noreturn]] void fail(const std::size_t  line,
                           const std::size_t  column,
                           const std::string &why) const;

    std::filesystem::path                      file;
    std::map<std::string, std::string>         comment_values;
    std::map<std::string, std::vector<double>> values;

    /// Position in the file of each column that is read.
    std::map<std::string, std::size_t> cell_of;
    std::size_t                        n_cells     = 0;
    std::size_t                        line_number = 0;

    /// Line of each row, and, flattened, where each of its read cells begins:
    /// kept so that later checks can point at a cell.
    std::vector<std::size_t>  line_of_row;
    std::vector<unsigned int> begin_of_cell;
  };

  /// Shortest decimal text that reads back as exactly the same number.
  std::string exact_text(const double value);
} // namespace SlipStep

#endif
