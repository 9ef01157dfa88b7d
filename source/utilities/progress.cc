// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>

#include <boost/algorithm/string/predicate.hpp>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>

namespace SlipStep
{
  bool Progress::often = false;

  namespace
  {
    // A line that wraps cannot be redrawn: cut to the terminal's width, but not
    // the time left.
    std::string fitted(const std::string &line, const std::string &end)
    {
      winsize           size{};
      const std::size_t width =
        ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ?
          size.ws_col - 1u :
          79u;
      if (line.size() + end.size() <= width)
        return line + end;
      const std::string gap  = " ...";
      const std::size_t rest = end.size() + gap.size();
      std::string       kept = line.substr(0, width > rest ? width - rest : 0);
      // Not half a character.
      while (!kept.empty() && (kept.back() & 0x80) != 0)
        kept.pop_back();
      return kept + gap + end;
    }



    std::string percentage(const double fraction)
    {
      char text[32];
      std::snprintf(text,
                    sizeof(text),
                    "[%5.1f %%] ",
                    // 100.0 is kept for the end.
                    fraction >= 1. ? 100. : std::min(100. * fraction, 99.9));
      return text;
    }
  } // namespace



  Progress::Progress(const bool quiet, const std::string &label)
    : Progress(quiet,
               label,
               std::cout,
               !is_under_mpirun() && isatty(STDOUT_FILENO) == 1)
  {}



  Progress::Progress(const bool         quiet,
                     const std::string &label,
                     std::ostream      &out,
                     const bool         is_live)
    : quiet(quiet)
    , label(label)
    , out(out)
    , is_live(is_live)
    , start(Clock::now())
    , last_print(start)
  {}



  Progress::~Progress()
  {
    if (line_is_open)
      out << std::endl;
  }



  void Progress::update(const double       fraction,
                        const std::string &text,
                        const double       time_left)
  {
    if (quiet || is_finished)
      return;
    const Clock::time_point now = Clock::now();
    const double            waited =
      std::chrono::duration<double>(now - last_print).count();
    const bool is_due =
      !has_printed ||
      (is_live || often ? waited > 0.2 :
                          waited > 10. || fraction >= last_fraction + 0.05);
    if (!is_due)
      return;
    has_printed   = true;
    last_print    = now;
    last_fraction = fraction;
    print(fraction, text, time_left);
  }



  double Progress::time_spent() const
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }



  void Progress::print(const double       fraction,
                       const std::string &text,
                       const double       time_left)
  {
    const std::string line =
      percentage(fraction) + (label.empty() ? "" : label + ": ") + text;
    const std::string end =
      std::isfinite(time_left) && fraction < 1. ?
        ", about " + duration_in_words(time_left) + " left" :
        "";
    if (is_live)
      {
        out << "\r\033[K" << fitted(line, end) << std::flush;
        line_is_open = true;
      }
    else
      out << line << end << std::endl;
  }



  void Progress::finish(const std::string &outcome)
  {
    if (quiet || is_finished)
      return;
    print(1., outcome + " " + duration_in_words(time_spent()));
    if (is_live)
      out << std::endl;
    line_is_open = false;
    is_finished  = true;
  }



  void Progress::clear()
  {
    if (line_is_open)
      out << "\r\033[K" << std::flush;
    line_is_open = false;
    has_printed  = has_printed && !is_live;
  }



  void Progress::report_often()
  {
    often = true;
  }



  bool parse_progress_line(const std::string &line, ProgressLine &parsed)
  {
    double percent = 0.;
    int    length  = 0;
    if (std::sscanf(line.c_str(), "[%lf %%]%n", &percent, &length) != 1 ||
        length == 0)
      return false;
    parsed.fraction = std::clamp(percent / 100., 0., 1.);
    parsed.text = line.substr(std::min<std::size_t>(length + 1, line.size()));
    const std::size_t label = parsed.text.find(": ");
    if (label != std::string::npos)
      parsed.text.erase(0, label + 2);
    parsed.time_left        = std::numeric_limits<double>::quiet_NaN();
    const std::string about = ", about ", left = " left";
    const std::size_t begin = parsed.text.rfind(about);
    if (begin != std::string::npos &&
        boost::algorithm::ends_with(parsed.text, left))
      {
        const std::size_t words = begin + about.size();
        parsed.time_left        = parse_duration(
          parsed.text.substr(words, parsed.text.size() - left.size() - words));
        parsed.text.erase(begin);
      }
    return true;
  }



  std::string duration_in_words(const double seconds)
  {
    if (seconds < 9.95)
      {
        char text[32];
        std::snprintf(text, sizeof(text), "%.1f s", std::max(seconds, 0.));
        return text;
      }
    const long long total = std::llround(seconds);
    if (total < 60)
      return std::to_string(total) + " s";
    if (total < 3600)
      return std::to_string(total / 60) + " min " + std::to_string(total % 60) +
             " s";
    return std::to_string(total / 3600) + " h " +
           std::to_string(total / 60 % 60) + " min";
  }



  double parse_duration(const std::string &words)
  {
    std::istringstream in(words);
    double             sum = 0.;
    std::string        unit;
    for (double number; in >> number >> unit;)
      sum += number * (unit == "h" ? 3600. : unit == "min" ? 60. : 1.);
    return unit.empty() ? std::numeric_limits<double>::quiet_NaN() : sum;
  }
} // namespace SlipStep
