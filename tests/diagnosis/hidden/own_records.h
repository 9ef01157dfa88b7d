// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_diagnosis_hidden_own_records_h
#define tests_diagnosis_hidden_own_records_h

#include <tests/diagnosis/hidden/trial.h>
#include <tests/experiment/point_run.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <random>

namespace SlipStep::Testing
{
  struct Slide
  {
    double speed; ///< [mm/s], 0 is a rest
    double duration;
  };

  class OwnRecords : public testing::Test
  {
  protected:
    // Friction after a time step of a contact whose load point has come there
    // with that speed.
    using Contact = std::function<
      double(double friction, double speed, double position, double step)>;

    // Friction that follows the speed at once and does not change at rest;
    // flanks are of a spring.
    void write(
      const double                         per_decade,
      const std::function<double(double)> &factor_at = [](double) {
        return 1.;
      })
    {
      write([=]() {
        return [=](const double friction,
                   const double speed,
                   const double position,
                   const double step) {
          const double strength =
            speed == 0. ?
              std::abs(friction) :
              0.2 * (1. + per_decade * std::log10(std::abs(speed) / 0.2)) *
                factor_at(position);
          return std::clamp(friction + stiffness * speed * step,
                            -strength,
                            strength);
        };
      });
    }

    // Rate and state by the slip law, sinh regularised, on the same spring.
    void write_slip_law(const double a,
                        const double b,
                        const double slip_length,
                        const double first_state)
    {
      write([=]() {
        return [=, state = first_state](const double friction,
                                        const double speed,
                                        const double,
                                        const double step) mutable {
          constexpr double reference = 0.2;
          const double     strength =
            0.2 + b * std::log(state * reference / slip_length);
          const auto slip_rate = [&](const double f) {
            return 2. * reference * std::exp(-strength / a) * std::sinh(f / a);
          };
          double lower = -1., upper = 1.;
          for (unsigned int n = 0; n < 50; ++n)
            {
              const double f = (lower + upper) / 2.;
              (f - friction - stiffness * (speed - slip_rate(f)) * step > 0. ?
                 upper :
                 lower)      = f;
            }
          const double rate = std::max(std::abs(slip_rate(lower)), 1e-30);
          const double worn = std::exp(-rate * step / slip_length);
          state             = std::exp(worn * std::log(state) +
                           (1. - worn) * std::log(slip_length / rate));
          return lower;
        };
      });
    }

    static inline const std::string usual_contact =
      "set Friction/Tangential stiffness = 100\n"
      "set Friction/subloading/Rate = 500\n"
      "set Calibration/Parameters = Friction/Static coefficient from 0.02 "
      "to 0.6; Friction/Tangential stiffness from 5 to 2000 log; "
      "Friction/subloading/Rate from 20 to 5000 log";

    void read(const std::string &effects, const std::string &contact)
    {
      std::ofstream(folder.path() / "case.prm")
        << "set Loading/Programme = press 5 MPa in 1 s; slide 0.2 mm/s for "
           "20 mm\n"
           "set Friction/Effects = "
        << effects
        << "\n"
           "set Friction/Static coefficient = 0.15\n"
           "set Calibration/Tests = measured\n"
        << contact << '\n';
      parameters = Parameters();
      declare_loading_parameters(parameters);
      FrictionLaw::declare_parameters(parameters);
      declare_calibration_parameters(parameters);
      declare_diagnosis_parameters(parameters);
      parameters.read(folder.path() / "case.prm");
      ingested = ingest(parameters, {});
    }

    Judgement judged(const std::string &effects,
                     const std::string &more,
                     const std::string &contact = usual_contact)
    {
      read(effects, contact + more);
      return judge(*ingested.workspace, ingested.base);
    }

    TemporaryFolder folder;
    Parameters      parameters;
    Ingested        ingested;
    double          stiffness = 20.; // friction per mm
    double          angle     = 0.;  // of the motion to x
    double          across    = 0.;  // noise of a sensor there
    double          pressure  = 5.;
    double          noise     = 0.002; // of a row
    double          spike     = 0.;    // of some
    unsigned int    n_rows    = 180;

    // Every condition twice, each by a contact of its own.
    void write(const std::function<Contact()> &contact)
    {
      const std::vector<std::vector<Slide>> conditions = {
        {{0.02, 300.}},
        {{0.2, 30.}},
        {{2., 3.}},
        {{0.2, 20.}, {2., 2.}, {0.02, 100.}, {0.2, 10.}},
        {{0.2, 15.}, {-0.2, 15.}, {0.2, 15.}, {-0.2, 15.}},
        {{2., 2.}, {-2., 2.}, {2., 2.}},
        {{0.2, 15.}, {0., 10.}, {0.2, 10.}, {0., 300.}, {0.2, 10.}}};
      for (unsigned int i = 0; i < 2 * conditions.size(); ++i)
        write(i, conditions[i / 2], contact());
    }

    void write(const unsigned int        number,
               const std::vector<Slide> &slides,
               const Contact            &contact)
    {
      constexpr unsigned int n_within = 50;

      std::filesystem::create_directories(folder.path() / "measured");
      std::ofstream out(folder.path() / "measured" /
                        ("t" + std::to_string(10 + number) + ".csv"));
      out.precision(9);
      out << "# condition: " << number / 2
          << "\ntime_s,displacement_mm,displacement_y_mm,pressure_MPa,"
             "friction,friction_y\n0,0,0,5,0,0\n";
      const double gain = 1. + 0.005 * normal(random);
      double       time = 0., displacement = 0., friction = 0.;
      for (const Slide &slide : slides)
        for (unsigned int row = 0; row < n_rows / slides.size(); ++row)
          {
            const double step =
              slide.duration / (n_rows / slides.size()) / n_within;
            for (unsigned int i = 0; i < n_within; ++i)
              {
                time += step;
                displacement += slide.speed * step;
                friction = contact(friction, slide.speed, displacement, step);
              }
            constexpr unsigned int between = 60;
            const double measured = gain * friction + noise * normal(random) +
                                    (row % between == between / 2 ? spike : 0.);
            const double beside = across * normal_across(random_across);
            const double c = std::cos(angle), s = std::sin(angle);
            out << time << ',' << c * displacement << ',' << s * displacement
                << ',' << pressure << ',' << c * measured - s * beside << ','
                << s * measured + c * beside << '\n';
          }
    }

    std::mt19937_64            random{1}, random_across{2};
    std::normal_distribution<> normal, normal_across;
  };
} // namespace SlipStep::Testing

#endif
