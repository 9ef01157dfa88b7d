// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_calibration_planted_h
#define tests_calibration_planted_h

#include <slipstep/calibration/calibrate.h>
#include <slipstep/calibration/simulator.h>
#include <slipstep/measured_data/measured_test.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "../experiment/point_run.h"
#include "tests/temporary_folder.h"

namespace SlipStep
{
  namespace Testing
  {
    inline Parameters calibration_case(const Settings &settings)
    {
      Parameters parameters = point_parameters({});
      declare_calibration_parameters(parameters);
      set_all(settings, parameters);
      return parameters;
    }



    /// A slide from rest under 5.8 MPa, as it would be recorded at equal
    /// distances, or, with a power above 1, at shorter ones in the beginning:
    /// the law's friction, and noise, of which a row keeps a share.
    inline MeasuredTest planted_test(const Parameters  &truth,
                                     const double       speed,  // [mm/s]
                                     const double       length, // [mm]
                                     const unsigned int n_rows,
                                     const double       noise,
                                     std::mt19937      &random,
                                     const double       power = 1.,
                                     const double       kept  = 0.)
    {
      MeasuredTest test;
      test.name = "planted, " + std::to_string(60. * speed) + " mm per min";
      test.condition = test.name;
      for (unsigned int i = 0; i < n_rows; ++i)
        {
          const double share =
            std::pow(static_cast<double>(i) / (n_rows - 1), power);
          test.time.push_back(share * length / speed);
          test.displacement.push_back(share * length);
          test.pressure.push_back(5.8);
        }
      test.friction.assign(n_rows, 0.);
      const FrictionLaw law(truth);
      Replay            replay(test);
      replay.plan(law, Machine(), 1e-7);
      // Without the error of the steps to first order.
      const Replay  fine = replay.halved();
      Replay::Curve coarse, half;
      replay.simulate(law, Machine(), coarse);
      fine.simulate(law, Machine(), half);
      coarse.friction = replay.at(coarse.friction, test.time);
      test.friction   = fine.at(half.friction, test.time);
      for (unsigned int i = 0; i < n_rows; ++i)
        test.friction[i] += test.friction[i] - coarse.friction[i];
      std::normal_distribution<double> normal(0., 1.);
      double                           own = 0.;
      for (unsigned int i = 0; i < n_rows; ++i)
        {
          const double fresh = noise * normal(random);
          own =
            i == 0 ? fresh : kept * own + std::sqrt(1. - kept * kept) * fresh;
          test.friction[i] += own;
        }
      return test;
    }



    /// Write planted tests at 1, 20 and 200 mm/min, as often as told, each with
    /// a gain of its own.
    inline void plant_with_gains(const std::filesystem::path      &folder,
                                 const Parameters                 &truth,
                                 const unsigned int                n_replicates,
                                 std::normal_distribution<double> &gain,
                                 std::mt19937                     &random)
    {
      unsigned int n = 0;
      for (unsigned int replicate = 0; replicate < n_replicates; ++replicate)
        for (const double speed : {1., 20., 200.})
          {
            MeasuredTest test =
              planted_test(truth, speed / 60., 100., 120, 1e-3, random);
            const double factor = gain(random);
            for (double &friction : test.friction)
              friction *= factor;
            write_measured_test(folder /
                                  ("test_" + std::to_string(n++) + ".csv"),
                                test);
          }
    }



    /// Write planted tests at several speeds [mm/min] into a folder.
    inline void plant(const std::filesystem::path &folder,
                      const Parameters            &truth,
                      const std::vector<double>   &speeds,
                      const unsigned int           n_rows,
                      const double                 noise,
                      const unsigned int           seed,
                      const double                 length = 100.,
                      const double                 power  = 1.,
                      const double                 kept   = 0.)
    {
      std::filesystem::create_directories(folder);
      std::mt19937 random(seed);
      for (std::size_t i = 0; i < speeds.size(); ++i)
        {
          MeasuredTest test = planted_test(
            truth, speeds[i] / 60., length, n_rows, noise, random, power, kept);
          test.name += ", " + std::to_string(i);
          write_measured_test(folder / ("test_" + std::to_string(i) + ".csv"),
                              test);
        }
    }



    /// The constants of the source paper, its coefficients as read at 1 mm/min.
    inline const Settings paper = {{"Friction/Static coefficient", "0.0899"},
                                   {"Friction/softening/Kinetic coefficient",
                                    "0.0766"}};

    inline const char *const four =
      "Friction/Static coefficient from 0.05 to 0.2 start 0.1; "
      "Friction/softening/Kinetic coefficient from 0.03 to 0.2 start 0.08; "
      "Friction/softening/Rate from 0.005 to 1 start 0.1; "
      "Friction/overstress/Exponent from 5 to 50 start 15";



    class Planted : public testing::Test
    {
    protected:
      Parameters fitting(const Settings &more) const
      {
        Settings settings = paper;
        settings.emplace_back("Calibration/Tests", folder.path().string());
        settings.insert(settings.end(), more.begin(), more.end());
        return calibration_case(settings);
      }

      TemporaryFolder folder;
    };



    inline double truth_of(const std::string &path)
    {
      return calibration_case(paper).number(path);
    }
  } // namespace Testing
} // namespace SlipStep

#endif
