// SPDX-License-Identifier: Apache-2.0
// The rows of the one option table, by what they are about. optionTable() joins them in this order.
#pragma once

#include <gnomon/option_table.h>

#include <vector>

namespace gnomon {

void addTechniqueRows(std::vector<OptionRow>& table); // the choices and what belongs to them
void addPlanRows(std::vector<OptionRow>& table);      // how far shadows reach, how the view is divided
void addStepRows(std::vector<OptionRow>& table);      // a sun that moves in steps, what is kept of a map
void addSoftenRows(std::vector<OptionRow>& table);    // the blur of the mask on the screen
void addMomentRows(std::vector<OptionRow>& table);    // the filterable maps

} // namespace gnomon
