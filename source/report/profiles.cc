// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_report.h>
#include <slipstep/report/profiles.h>

namespace SlipStep
{
  namespace
  {
    const LegendLine profile_line   = {"profile", Colour::after},
                     parabola_line  = {"curvature alone", "#666666", "dashed"},
                     threshold_line = {"threshold", "#222222"},
                     end_line       = {"end of the interval",
                                       Colour::before,
                                       "dashed"},
                     bound_line     = {"bound", "#999999"},
                     value_line     = {"fitted value", Colour::before, "dot"};

    /// What is seen of a profile.
    struct ProfileView
    {
      Range  x;
      double highest        = 0.;
      bool   is_logarithmic = false;
    };

    ProfileView view_of(const DrawnProfile &profile)
    {
      ProfileView view;
      Range       y;
      for (const auto &[value, increase] : profile.profile)
        y.add(increase);
      view.highest = std::clamp(1.05 * y.upper, 1.4, 3.);
      for (const auto &[value, increase] : profile.profile)
        if (increase <= view.highest)
          view.x.add(value);
      for (const double value : {profile.value, profile.lower, profile.upper})
        view.x.add(value);
      // Over a short stretch a logarithmic axis looks the same, but finds no
      // round numbers.
      view.is_logarithmic =
        view.x.lower > 0. &&
        view.x.upper > (profile.is_logarithmic ? 3. : 10.) * view.x.lower;
      const double share = 0.06;
      if (view.is_logarithmic || view.x.width() > 0.)
        view.x = with_margin(view.x, share, view.is_logarithmic);
      else
        {
          const double margin = std::max(share * std::abs(view.x.upper), 1e-9);
          view.x              = {view.x.lower - margin, view.x.upper + margin};
        }
      return view;
    }

    /// Values between two, evenly on the scale.
    double between(const double begin,
                   const double end,
                   const double share,
                   const bool   is_logarithmic)
    {
      return is_logarithmic ? begin * std::pow(end / begin, share) :
                              begin + share * (end - begin);
    }

    /// What the curvature at the optimum alone would say.
    Rows parabola(const DrawnProfile &profile, const ProfileView &view)
    {
      Rows rows;
      if (!std::isfinite(profile.distance) || !(profile.distance > 0.))
        return rows;
      constexpr int n = 120;
      for (int i = 0; i <= n; ++i)
        {
          const double value = between(view.x.lower,
                                       view.x.upper,
                                       static_cast<double>(i) / n,
                                       view.is_logarithmic);
          const double away =
            (profile.is_logarithmic ? std::log(value / profile.value) :
                                      value - profile.value) /
            profile.distance;
          if (std::isfinite(away) && away * away <= 2. * view.highest)
            rows.push_back({value, away * away});
        }
      return rows;
    }

    /// A profile between the points that were computed and the ends of the
    /// interval. Its square root, with a sign, is nearly a straight line.
    Rows interpolated(const DrawnProfile &profile)
    {
      constexpr int n_between = 12;
      auto          points    = profile.profile;
      if (!profile.is_lower_open)
        points.emplace_back(profile.lower, 1.);
      if (!profile.is_upper_open)
        points.emplace_back(profile.upper, 1.);
      remove_erase_if(points, [](const auto &point) {
        return !std::isfinite(point.first) || !std::isfinite(point.second);
      });
      std::sort(points.begin(), points.end());
      const auto root = [&](const std::size_t i) {
        return std::copysign(std::sqrt(std::max(points[i].second, 0.)),
                             points[i].first - profile.value);
      };
      Rows rows;
      for (std::size_t i = 1; i < points.size(); ++i)
        for (int k = i == 1 ? 0 : 1; k <= n_between; ++k)
          {
            const double share = static_cast<double>(k) / n_between;
            const double at    = root(i - 1) + share * (root(i) - root(i - 1));
            rows.push_back(
              {between(points[i - 1].first,
                       points[i].first,
                       share,
                       profile.is_logarithmic && points[i - 1].first > 0.),
               at * at});
          }
      return rows;
    }

    void draw_profile(SmallPicture &picture, const DrawnProfile &profile)
    {
      const ProfileView view = view_of(profile);
      // The full precision keeps short intervals far from zero apart.
      picture.script().precision(12);
      const auto upright = [&](const double value, const std::string &style) {
        if (value >= view.x.lower && value <= view.x.upper)
          picture.script() << "set arrow nohead from first " << value
                           << ", graph 0 to first " << value << ", graph 1 "
                           << style << '\n';
      };
      upright(profile.lower_bound, bound_line.style(4.));
      upright(profile.upper_bound, bound_line.style(4.));
      if (!profile.is_lower_open)
        upright(profile.lower, end_line.style(1.8));
      if (!profile.is_upper_open)
        upright(profile.upper, end_line.style(1.8));

      picture.plot_level(1., threshold_line.style(1.));
      const auto plot = [&](const std::string &what,
                            const Rows        &rows,
                            const std::string &style) {
        picture.plot(picture.add_data(profile.name + what,
                                      {"value", "over_threshold"},
                                      rows) +
                     " with " + style);
      };
      const Rows curve = parabola(profile, view);
      if (!curve.empty())
        plot(", from the curvature",
             curve,
             "lines " + parabola_line.style(1.5));
      plot(", between the points",
           interpolated(profile),
           "lines " + profile_line.style());
      Rows rows;
      for (const auto &[value, increase] : profile.profile)
        rows.push_back({value, increase});
      plot("",
           rows,
           "points pt 7 ps 0.35 lc rgb '" + profile_line.colour + "'");
      plot(", fitted",
           {{profile.value, 0.}},
           "points pt 7 ps 0.9 lc rgb '" + value_line.colour + "'");
      picture.axes(axis_label(profile.name, profile.unit),
                   view.x,
                   "Increase / threshold  [–]",
                   {0., view.highest},
                   view.is_logarithmic);
    }
  } // namespace



  std::string draw_profiles(Page                            &page,
                            const std::string               &title,
                            const std::vector<DrawnProfile> &profiles,
                            const double                     confidence)
  {
    Gallery     gallery{title,
                    "Increase of the misfit when one parameter is held and the "
                        "others are fitted again, over the threshold of the " +
                      interval_name(confidence) +
                      ": where it exceeds 1, the tests contradict the value. A "
                          "flat curve says that they do not determine it.",
                    {profile_line}};
    bool        has_parabola = false, has_bound = false;
    std::size_t n = 0;
    for (const DrawnProfile &profile : profiles)
      if (profile.profile.size() > 1)
        {
          SmallPicture picture(page,
                               "profile_" + std::to_string(++n),
                               profile.name);
          draw_profile(picture, profile);
          picture.finish(gallery);
          has_parabola = has_parabola || std::isfinite(profile.distance);
          has_bound    = has_bound || std::isfinite(profile.lower_bound) ||
                      std::isfinite(profile.upper_bound);
        }
    if (has_parabola)
      gallery.legend.push_back(parabola_line);
    gallery.legend.insert(gallery.legend.end(), {threshold_line, end_line});
    if (has_bound)
      gallery.legend.push_back(bound_line);
    gallery.legend.push_back(value_line);
    return gallery_section(gallery);
  }
} // namespace SlipStep
