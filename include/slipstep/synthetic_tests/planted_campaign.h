// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_planted_campaign_h
#define slipstep_synthetic_tests_planted_campaign_h

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/synthetic_tests/record_noise.h>
#include <slipstep/synthetic_tests/true_contact.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace SlipStep
{
  namespace Planting
  {
    /// What is hidden in a campaign.
    enum class CampaignClass
    {
      none,          ///< nothing; the start model is only badly set
      one,           ///< an effect of the catalogue, with its formula
      two,           ///< two of them
      other_formula, ///< an effect of the catalogue in another formula
      outside,       ///< an effect that the catalogue does not have
      ablated,       ///< the start model lacks overstress or softening
      narrow,        ///< one, but the tests hardly tell effects apart
      third_formula, ///< an effect of the catalogue in a third formula
      joint          ///< two effects that nearly hide each other
    };

    /// "other_formula"
    std::string to_string(const CampaignClass campaign_class);

    /// @throws InputError naming the nearest if there is none
    CampaignClass campaign_class(const std::string &name);

    /// Names of all classes.
    std::vector<std::string> campaign_classes();

    /// The mathematics of what a class hides.
    Formula formula_of(const CampaignClass campaign_class);

    /// The effects that a class draws from in an edition.
    std::vector<std::string> drawn_effects(const CampaignClass campaign_class,
                                           const unsigned int  edition);

    /// The edition of the effect that was added last.
    unsigned int newest_edition();

    /// A campaign is a function of these alone. Each of the three, what is
    /// planted, the tests, and the noise, has its own random numbers: with
    /// other noise or other tests the truth stays the same.
    struct CampaignOptions
    {
      CampaignClass campaign_class = CampaignClass::one;
      std::uint64_t seed           = 1;
      /// Effects that were added later are not drawn.
      unsigned int edition = 1;
      /// Hide these instead of drawn ones.
      std::vector<std::string> effects;
      /// Relative change of friction by the hidden effects; 0: drawn between
      /// least_amplitude and largest_amplitude.
      double       amplitude = 0.;
      unsigned int n_tests   = 20;
      /// Whether three tests in ten repeat the condition of another.
      bool      with_replicates = true;
      NoiseKind noise           = NoiseKind::normal;
      double    noise_factor    = 1.; ///< on all parts of the noise
    };

    constexpr double least_amplitude   = 0.003;
    constexpr double largest_amplitude = 0.08;

    struct PlantedEffect
    {
      std::string                 name;
      Formula                     formula;
      std::string                 formula_text;
      double                      amplitude;
      std::vector<TruthParameter> parameters;
    };

    /// A test as measured, and what it would be without noise.
    struct PlantedTest
    {
      MeasuredTest measured;
      /// At the rows of the test, along both axes, without noise.
      TrueFriction truth;
      /// Of what is in the record of this test: gain, offset.
      RecordNoise noise;
    };

    struct PlantedCampaign
    {
      CampaignOptions options;

      /// The contact as it is, hidden effects and all.
      TrueContact contact;
      /// Names of effects of the law that the truth has, hidden or not.
      std::vector<std::string>    base_effects;
      std::vector<TruthParameter> base_parameters;
      std::vector<PlantedEffect>  hidden; ///< empty if nothing is missing
      NoiseLevels                 noise;

      /// In the order in which they were run.
      std::vector<PlantedTest> tests;

      /// The text of a case file: the base without what is hidden, badly set,
      /// with the parameters to be fitted. Its tests are in "measured".
      std::string start_model;
    };

    /// @throws InputError for effects that do not exist, or are too many for
    ///   the class
    PlantedCampaign plant_campaign(const CampaignOptions &options);

    /// @throws InputError if there is something in the folder already
    void check_is_free(const std::filesystem::path &folder);

    /// Write FOLDER/case.prm and FOLDER/measured/*.csv.
    /// @throws InputError if the folder cannot be made or has a campaign
    /// already
    void write_campaign(const std::filesystem::path &folder,
                        const PlantedCampaign       &campaign);
  } // namespace Planting
} // namespace SlipStep

#endif
