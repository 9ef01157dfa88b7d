// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_record_warnings_h
#define slipstep_diagnosis_record_warnings_h

#include <slipstep/diagnosis/ingest.h>

namespace SlipStep
{
  /// Add to the warnings what the records and their noise are not fit for.
  void warn_of_records(Ingested &ingested);
} // namespace SlipStep

#endif
