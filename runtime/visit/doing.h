#pragma once
#include "attendance.h"
#include "input/exhibit_state.h"

namespace starbow {

/// The course of the visit, for the guide. record: the source shows a recorded flight.
Doing doing_of(const Attendance& attendance, const FlightSource& source, bool record);

} // namespace starbow
