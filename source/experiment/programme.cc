// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/follow_warnings.h>
#include <slipstep/experiment/programme.h>

#include <slipstep/measured_data/arc.h>
#include <slipstep/measured_data/rounded_motion.h>
#include <slipstep/measured_data/sensor_noise.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace SlipStep
{
  namespace
  {
    /// In mm, s and MPa: beyond it rounding spoils what the law adds up.
    constexpr double largest_number = 1e15;

    /// How each verb is written: shown when something is missing. Which
    /// keywords it takes is read from here, too.
    const std::map<std::string, std::string> usage = {
      {"press", "press 5.8 MPa in 1 s"},
      {"hold", "hold 10 s"},
      {"slide", "slide 1 mm/min for 60 mm at 0 deg"},
      {"push", "push 1.2 MPa in 1 s at 0 deg"},
      {"follow", "follow measured/test_01.csv"},
      {"repeat",
       "repeat 10 times { slide 1 mm/s for 2 s; slide -1 mm/s for 2 s }"}};

    /// More are a slip of the pen, or a run without end.
    constexpr unsigned int most_statements = 100000, most_nested = 10;

    const char *const push_example =
      "write e.g. 'push between 0.5 MPa and 1.5 MPa 20 times, 1 s each'";

    const std::vector<std::string> keywords = {"in", "for", "at"};



    /// A piece of the text of a programme and where it begins.
    struct Piece
    {
      std::string text;
      std::size_t column = 0;

      /// The column behind it.
      std::size_t end() const
      {
        return column + text.size();
      }
    };

    /// What separates statements, or holds those of a repetition together.
    constexpr const char *borders = ";{}";

    /// What separates words.
    constexpr const char *blanks = " \t\r\n";

    Piece trim(const Piece &piece)
    {
      const auto begin = piece.text.find_first_not_of(blanks);
      if (begin == std::string::npos)
        return {"", piece.column};
      const auto end = piece.text.find_last_not_of(blanks);
      return {piece.text.substr(begin, end - begin + 1), piece.column + begin};
    }



    std::vector<Piece> words(const Piece &piece)
    {
      std::vector<Piece> result;
      std::size_t        begin = piece.text.find_first_not_of(blanks);
      while (begin != std::string::npos)
        {
          const auto end = std::min(piece.text.find_first_of(blanks, begin),
                                    piece.text.size());
          result.push_back(
            {piece.text.substr(begin, end - begin), piece.column + begin});
          begin = piece.text.find_first_not_of(blanks, end);
        }
      return result;
    }



    class Parser
    {
    public:
      Parser(const std::string           &text,
             const double                 default_speed,
             const std::filesystem::path &directory)
        : text(text)
        , default_speed(default_speed)
        , directory(directory)
      {
        for (char &c : this->text)
          if (c == '\n' || c == '\t' || c == '\r')
            c = ' ';
      }

      std::vector<Segment> parse()
      {
        run_statements(0);
        if (segments.empty())
          throw InputError("the programme is empty; write e.g. 'press 5.8 MPa "
                           "in 1 s; hold 10 s; slide 1 mm/min for 60 mm'");
        return segments;
      }

      /// Every test once.
      std::vector<FollowedTest> followed;

      /// What was done to the rows of tests that are followed.
      std::vector<std::string> warnings;

      bool takes_default_speed = false;

    private:
      /// A verb and what follows it, by keyword; the part right after the verb
      /// has the keyword "".
      struct Statement
      {
        Piece                        verb;
        std::map<std::string, Piece> parts;
        std::size_t                  end = 0;
      };

      /// Carry out what stands from a column up to the brace that closes it, or
      /// up to the end of the text.
      /// @param opened column of the brace that opened it, if one did
      /// @return the column behind
      std::size_t run_statements(std::size_t                      begin,
                                 const std::optional<std::size_t> opened = {})
      {
        while (begin < text.size())
          {
            const auto end =
              std::min(text.find_first_of(borders, begin), text.size());
            const char  border = end < text.size() ? text[end] : ';';
            const Piece piece  = trim({text.substr(begin, end - begin), begin});
            begin              = end + 1;
            if (border == '{')
              begin = repeat(piece, end);
            else if (!piece.text.empty())
              run(piece);
            if (border == '}')
              {
                if (!opened)
                  fail(end, "this '}' closes nothing");
                return begin;
              }
          }
        if (opened)
          fail(*opened, "this '{' is not closed; '}' is missing");
        return begin;
      }

      /// Carry out what is in the braces that begin at a column.
      /// @param header "repeat 10 times"
      /// @return the column behind
      std::size_t repeat(const Piece &header, const std::size_t brace)
      {
        const unsigned int n_times = number_of_times(header, brace);
        if (++n_nested > most_nested)
          fail(header.column, "repetitions are nested too deeply");
        const unsigned int n_before = n_statements;
        std::size_t        end      = 0;
        for (unsigned int time = 0; time < n_times; ++time)
          {
            end = run_statements(brace + 1, brace);
            if (n_statements == n_before)
              fail(brace, "there is nothing to repeat in these braces");
          }
        --n_nested;
        const std::size_t next = text.find_first_not_of(blanks, end);
        if (next != std::string::npos && text[next] != ';' && text[next] != '}')
          fail(next, "a ';' is missing after '}'");
        return end;
      }

      unsigned int number_of_times(const Piece      &header,
                                   const std::size_t brace) const
      {
        const std::vector<Piece> all = words(header);
        const std::string example = "write e.g. '" + usage.at("repeat") + "'";
        const std::string verb    = all.empty() ? "" : lower_case(all[0].text);
        if (verb != "repeat")
          fail(all.empty() || usage.count(verb) > 0 ? brace : header.column,
               "braces follow 'repeat'; " + example);
        if (all.size() < 2)
          fail(header.end(), "how many times? " + example);
        const unsigned int number = count(all[1], example);
        if (all.size() != 3 || (!is_same_word(all[2].text, "times") &&
                                !is_same_word(all[2].text, "time")))
          fail(all.size() < 3 ? all[1].end() : all[2].column,
               "expected 'times' and a brace; " + example);
        return number;
      }

      /// A number of times.
      unsigned int count(const Piece &number, const std::string &example) const
      {
        if (number.text.find_first_not_of("0123456789") != std::string::npos ||
            number.text.find_first_not_of('0') == std::string::npos)
          fail(number.column, "expected a number of times; " + example);
        if (number.text.size() > 9)
          fail(number.column, "these are too many times");
        return std::stoul(number.text);
      }

      void run(const Piece &piece)
      {
        const Statement statement = read_statement(piece);
        statement_column          = statement.verb.column;
        if (n_statements == most_statements)
          fail(statement_column,
               "with this repeated, the programme has more than " +
                 std::to_string(most_statements) + " statements");
        if (statement.verb.text == "press")
          press(statement);
        else if (statement.verb.text == "hold")
          hold(statement);
        else if (statement.verb.text == "slide")
          slide(statement);
        else if (statement.verb.text == "push")
          push(statement);
        else
          follow(statement);
        ++n_statements;
      }

      void refuse_verb(const Piece &verb) const
      {
        std::vector<std::string> verbs;
        for (const auto &entry : usage)
          verbs.push_back(entry.first);
        const std::string nearest = nearest_name(verb.text, verbs);
        fail(verb.column,
             "unknown word '" + verb.text + "'" +
               (nearest.empty() ?
                  "; known are press, hold, slide, push, follow, repeat" :
                  "; did you mean '" + nearest + "'?"));
      }

      Statement read_statement(const Piece &piece) const
      {
        const std::vector<Piece> all = words(piece);

        Statement statement;
        statement.verb      = all.front();
        statement.verb.text = lower_case(statement.verb.text);
        statement.end       = piece.end();

        const std::string &verb = statement.verb.text;
        if (usage.count(verb) == 0)
          refuse_verb(statement.verb);
        if (verb == "repeat")
          fail(piece.end(),
               "what is repeated stands in braces; write e.g. '" +
                 usage.at(verb) + "'");

        // A file name may contain blanks and words that are keywords elsewhere.
        if (verb == "follow")
          {
            const Piece rest    = {text.substr(statement.verb.end(),
                                            piece.end() - statement.verb.end()),
                                   statement.verb.end()};
            statement.parts[""] = trim(rest);
            return statement;
          }

        for (std::size_t i = 1; i < all.size(); ++i)
          if (usage.count(lower_case(all[i].text)) > 0)
            fail(all[i - 1].text.back() == ',' ? all[i - 1].end() - 1 :
                                                 all[i].column,
                 "statements are separated by ';': it is missing before '" +
                   all[i].text + "'");
        Piece       start   = statement.verb;
        std::string keyword = "";
        for (std::size_t i = 1; i <= all.size(); ++i)
          if (i == all.size() || holds(keywords, lower_case(all[i].text)))
            {
              const auto end = i == all.size() ? piece.end() : all[i].column;
              statement.parts[keyword] = trim(
                {text.substr(start.end(), end - start.end()), start.end()});
              if (i == all.size())
                break;
              start   = all[i];
              keyword = lower_case(start.text);
              if (usage.at(verb).find(" " + keyword + " ") == std::string::npos)
                fail(start.column,
                     "'" + verb + "' has no '" + keyword + "'; write e.g. '" +
                       usage.at(verb) + "'");
              if (statement.parts.count(keyword) > 0)
                fail(start.column, "'" + keyword + "' is given twice");
            }
        return statement;
      }

      void press(const Statement &statement)
      {
        const Piece &pressure_text = part(statement, "");
        const double pressure      = quantity(pressure_text, Dimension::stress);
        if (pressure < 0.)
          fail(pressure_text.column, "a pressure must not be negative");
        add(positive(part(statement, "in"), Dimension::time, "time"),
            pressure,
            present.displacement);
      }

      void hold(const Statement &statement)
      {
        add(positive(part(statement, ""), Dimension::time, "time"),
            present.pressure,
            present.displacement);
      }

      void slide(const Statement &statement)
      {
        const Piece &speed_text = statement.parts.at("");
        const bool   is_stated  = !speed_text.text.empty();
        if (is_quantity(speed_text, Dimension::length) ||
            is_quantity(speed_text, Dimension::time))
          fail(speed_text.column,
               "a length or a time follows the word 'for': slide for " +
                 speed_text.text);
        const double speed =
          is_stated ? quantity(speed_text, Dimension::speed) : default_speed;
        takes_default_speed = takes_default_speed || !is_stated;
        if (speed == 0. || !std::isfinite(speed))
          fail(is_stated ? speed_text.column : statement.verb.column,
               is_stated ?
                 "a speed must not be zero; to rest, write 'hold 10 s'" :
                 "this slide states no speed, and the case gives none");

        const dealii::Tensor<1, 2> direction = direction_of(statement);

        const Piece &extent = part(statement, "for");
        double       length = 0., duration = 0.;
        if (is_quantity(extent, Dimension::time))
          {
            duration = positive(extent, Dimension::time, "time");
            length   = duration * std::abs(speed);
          }
        else
          {
            length   = positive(extent,
                              Dimension::length,
                              "length (to slide back, give a negative speed)");
            duration = length / std::abs(speed);
          }
        add(duration,
            present.pressure,
            present.displacement + std::copysign(length, speed) * direction);
      }

      void push(const Statement &statement)
      {
        const dealii::Tensor<1, 2> direction = direction_of(statement);
        const Piece               &load      = part(statement, "");
        if (is_same_word(words(load)[0].text, "between"))
          return push_between(statement, direction);
        for (const Piece &word : words(load))
          if (is_same_word(word.text, "between"))
            fail(word.column,
                 "'between' comes first; " + std::string(push_example));
        const double value = quantity(load, Dimension::stress);
        add_push(positive(part(statement, "in"), Dimension::time, "time"),
                 value * direction);
      }

      // "between 0.5 MPa and 1.5 MPa 20 times, 1 s each"
      void push_between(const Statement            &statement,
                        const dealii::Tensor<1, 2> &direction)
      {
        const std::string example = push_example;
        if (statement.parts.count("in") > 0)
          fail(statement.parts.at("in").column,
               "the time of a cycle comes before 'each', not after 'in'; " +
                 example);
        const Piece             &all  = statement.parts.at("");
        const std::vector<Piece> word = words(all);
        const auto find = [&](const std::vector<std::string> &names) {
          for (std::size_t i = 1; i < word.size(); ++i)
            for (const std::string &name : names)
              if (is_same_word(word[i].text, name))
                return i;
          fail(all.end(), "'" + names[0] + "' is missing; " + example);
        };
        const std::size_t middle = find({"and"});
        const std::size_t times  = find({"times,", "time,", "times", "time"});
        const std::size_t each   = find({"each"});
        if (!(1 < middle && middle + 2 < times && times + 1 < each &&
              each + 1 == word.size()))
          fail(all.column, "the words are not in order; " + example);
        // From a word up to another, that one not included.
        const auto between = [&](const std::size_t from, const std::size_t to) {
          return Piece{text.substr(word[from].column,
                                   word[to - 1].end() - word[from].column),
                       word[from].column};
        };
        const double low = quantity(between(1, middle), Dimension::stress);
        const double high =
          quantity(between(middle + 1, times - 1), Dimension::stress);
        if (low == high)
          fail(word[middle].column, "the two loads are the same");
        const unsigned int n_times = count(word[times - 1], example);
        if (n_times > (most_statements - n_statements) / 2)
          fail(word[times - 1].column, "these are too many times");
        const double duration =
          positive(between(times + 1, each), Dimension::time, "time");

        for (unsigned int n = 2 * n_times; n > 0; --n)
          {
            add_push(duration / 2., (n % 2 == 0 ? high : low) * direction);
            n_statements += n > 1;
          }
      }

      void follow(const Statement &statement)
      {
        const Piece                &name = part(statement, "");
        const std::filesystem::path file = directory / with_home(name.text);
        std::error_code             error;
        if (!std::filesystem::is_regular_file(file, error))
          fail(name.column,
               std::filesystem::is_directory(file, error) ?
                 excerpt(file.string(), 300) +
                   " is a folder: follow one of its tests" :
                 "there is no file " + excerpt(file.string(), 300));

        if (tests.count(name.text) == 0)
          {
            // A contact of 1e4 MPa/mm gives way by as much to some 0.5 MPa.
            constexpr double felt = 5e-5, felt_stairs = 2e-4; // [mm]
            MeasuredTest     read = read_measured_test(file);
            undo_rounding_of_time(read);
            if (rounding_of_motion(read) > felt_stairs)
              undo_rounding_of_motion(read);
            else
              take_off_noise_of_motion(read, felt);
            for (const auto &more :
                 {read.warnings,
                  follow_warnings(read, present.pressure, is_at_rest())})
              warnings.insert(warnings.end(), more.begin(), more.end());
            tests[name.text] = read;
          }
        const MeasuredTest &test   = tests.at(name.text);
        const auto          origin = present.displacement;
        followed.push_back(
          {test, segments.empty() ? 0. : segments.back().end_time, origin});
        for (std::size_t i = 1; i < test.time.size(); ++i)
          for (const PartOfWay &part : way_to(test, i))
            add((part.end - part.begin) * (test.time[i] - test.time[i - 1]),
                (1. - part.end) * test.pressure[i - 1] +
                  part.end * test.pressure[i],
                origin + (part.to - position(test, 0)));
      }

      /// Whether the drive has not pulled at the contact yet.
      bool is_at_rest() const
      {
        return none_of(segments, [](const Segment &segment) {
          return segment.pushes || segment.end.velocity.norm() > 0.;
        });
      }

      /// The part behind a keyword, which has to be there.
      const Piece &part(const Statement   &statement,
                        const std::string &keyword) const
      {
        const auto found = statement.parts.find(keyword);
        if (found == statement.parts.end() || found->second.text.empty())
          {
            const auto column = found == statement.parts.end() ?
                                  statement.end :
                                  found->second.column;
            fail(column,
                 "'" + statement.verb.text + "' needs " +
                   (keyword.empty() ? "a value" :
                                      "'" + keyword + "' with a value") +
                   "; write e.g. '" + usage.at(statement.verb.text) + "'");
          }
        return found->second;
      }

      /// The number and unit in @p piece, in base units.
      double quantity(const Piece &piece, const Dimension dimension) const
      {
        double      value = 0.;
        const char *begin = piece.text.data();
        const char *end   = begin + piece.text.size();
        const auto  stop = std::from_chars(begin + (*begin == '+'), end, value);
        if (const std::string hint = minus_hint(piece.text); !hint.empty())
          fail(piece.column, hint);
        if (stop.ec == std::errc::invalid_argument)
          fail(piece.column, "a number is missing before '" + piece.text + "'");
        const std::size_t comma = piece.text.find(',');
        const std::string hint  = decimal_comma_hint(piece.text);
        if (comma != std::string::npos)
          fail(piece.column + comma,
               "there are no commas: statements are separated by ';', and " +
                 (hint.empty() ? "decimals begin with a point" : hint));

        const std::size_t number_end = stop.ptr - begin;
        const Piece       unit =
          trim({piece.text.substr(number_end), piece.column + number_end});
        if (unit.text.empty() && dimension != Dimension::number)
          fail(piece.end(),
               "the unit is missing (e.g. " + base_unit(dimension) + ")");

        try
          {
            value = parse_quantity(piece.text, dimension, true);
          }
        catch (const InputError &error)
          {
            // If the first word alone is right, the rest does not belong here.
            const std::vector<Piece> parts = words(unit);
            if (parts.size() > 1 &&
                is_quantity({text.substr(piece.column,
                                         parts[0].end() - piece.column),
                             piece.column},
                            dimension))
              fail(parts[1].column,
                   "'" + parts[1].text +
                     "' is not expected here; use 'in', 'for', 'at' or ';'");
            fail(unit.text.empty() || stop.ec != std::errc() ||
                     !std::isfinite(value) ?
                   piece.column :
                   unit.column,
                 error.what());
          }
        if (std::abs(value) > largest_number)
          fail(piece.column, "the number is too large");
        return value;
      }

      /// A quantity that has to be above zero.
      double positive(const Piece      &piece,
                      const Dimension   dimension,
                      const std::string what) const
      {
        const double value = quantity(piece, dimension);
        if (!(value > 0.) || !std::isfinite(value))
          fail(piece.column, "expected a positive " + what);
        return value;
      }

      bool is_quantity(const Piece &piece, const Dimension dimension) const
      {
        try
          {
            parse_quantity(piece.text, dimension, true);
            return true;
          }
        catch (const InputError &)
          {
            return false;
          }
      }

      /// (cos, sin) of the angle behind 'at', (1, 0) without one.
      dealii::Tensor<1, 2> direction_of(const Statement &statement) const
      {
        double angle = 0.;
        if (statement.parts.count("at") > 0)
          angle = quantity(part(statement, "at"), Dimension::angle);
        dealii::Tensor<1, 2> direction;
        direction[0] = std::cos(angle);
        direction[1] = std::sin(angle);
        return direction;
      }

      /// Append a segment from the present state to the given one.
      void add(const double                duration,
               const double                pressure,
               const dealii::Tensor<1, 2> &displacement)
      {
        // Times are sums of durations: one that is lost in them never passes.
        if (!(duration <= largest_number))
          fail(statement_column, "this lasts longer than 1e15 s");
        if (duration < 1e-10 * time)
          fail(statement_column,
               "this lasts " + exact_text(duration) +
                 " s, too short to be resolved after the " + exact_text(time) +
                 " s before it");

        Segment segment;
        segment.start_time       = time;
        segment.end_time         = time + duration;
        segment.statement        = n_statements;
        segment.start            = present;
        segment.end.pressure     = pressure;
        segment.end.displacement = displacement;
        segment.start.velocity   = segment.end.velocity =
          (displacement - present.displacement) / duration;
        segments.push_back(segment);

        time    = segment.end_time;
        present = segment.end;
      }

      /// Append a segment that pushes up to a load, other things unchanged.
      void add_push(const double duration, const dealii::Tensor<1, 2> &load)
      {
        add(duration, present.pressure, present.displacement);
        segments.back().pushes = true;
        segments.back().push   = load;
      }

      [[noreturn]] void fail(const std::size_t  column,
                             const std::string &message) const
      {
        // A wrapped line would misplace the caret: show the neighbourhood only.
        const std::size_t width = 72;
        std::size_t       first = 0;
        if (text.size() > width && column > width / 2)
          first = std::min(column - width / 2, text.size() - width);
        const std::string before = first > 0 ? "..." : "";
        const std::string after  = first + width < text.size() ? "..." : "";
        throw InputError(
          "column " + std::to_string(column + 1) + ": " + message + "\n  " +
          before + text.substr(first, width) + after + "\n  " +
          std::string(before.size() + column - first, ' ') + "^");
      }

      std::string                 text;
      const double                default_speed;
      const std::filesystem::path directory;

      unsigned int         n_statements     = 0;
      unsigned int         n_nested         = 0;
      std::size_t          statement_column = 0;
      std::vector<Segment> segments;
      /// By file: a repeated one is read once.
      std::map<std::string, MeasuredTest> tests;
      double                              time = 0.;
      Loading                             present;
    };
  } // namespace



  Programme::Programme(const std::string           &text,
                       const double                 default_speed,
                       const std::filesystem::path &directory)
  {
    Parser parser(text, default_speed, directory);
    segment_list       = parser.parse();
    warning_list       = parser.warnings;
    followed_list      = parser.followed;
    is_speed_left_open = parser.takes_default_speed;
  }



  std::string relocated_programme(const std::string           &text,
                                  const std::filesystem::path &from,
                                  const std::filesystem::path &to)
  {
    const std::string verb = "follow";
    std::string       result;
    for (std::size_t begin = 0; begin < text.size();)
      {
        const auto end =
          std::min(text.find_first_of(borders, begin), text.size());
        const Piece piece = trim({text.substr(begin, end - begin), begin});
        const std::string name =
          is_same_word(piece.text.substr(0, verb.size()), verb) ?
            trim({piece.text.substr(verb.size()), 0}).text :
            "";
        if (name.empty())
          result += text.substr(begin, end - begin);
        else
          result += text.substr(begin, piece.column - begin) + verb + " " +
                    path_from(to, from / with_home(name));
        if (end < text.size())
          result += text[end];
        begin = end + 1;
      }
    return result;
  }
} // namespace SlipStep
