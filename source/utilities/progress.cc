#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

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



  void Progress::update(const double fraction, const std::string &text)
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
    print(fraction, text);
  }



  void Progress::start_at(const double fraction)
  {
    first_fraction = last_fraction = fraction;
  }



  void Progress::print(const double fraction, const std::string &text)
  {
    const double spent =
      std::chrono::duration<double>(Clock::now() - start).count();
    const std::string line =
      percentage(fraction) + (label.empty() ? "" : label + ": ") + text;
    std::string end;
    // The first instants say nothing about the rest.
    const double done = fraction - first_fraction;
    if (done > 0.005 && fraction < 1. && spent > 0.5)
      end = ", about " + duration_in_words(spent * (1. - fraction) / done) +
            " left";
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
    const double spent =
      std::chrono::duration<double>(Clock::now() - start).count();
    print(1., outcome + " " + duration_in_words(spent));
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
    const std::string left = " left";
    if (parsed.text.size() > left.size() &&
        parsed.text.compare(parsed.text.size() - left.size(),
                            left.size(),
                            left) == 0)
      parsed.text.erase(std::min(parsed.text.rfind(", "), parsed.text.size()));
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
} // namespace SlipStep
