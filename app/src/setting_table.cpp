// SPDX-License-Identifier: Apache-2.0
// The declaration of every option, joined from the files that setting_rows.h names.
#include "setting_rows.h"

namespace gnomon::app {

std::span<const Setting> settingTable()
{
    static const std::vector<Setting> table = [] {
        std::vector<Setting> made;
        addSceneRows(made);
        addTechniqueRows(made);
        addRunRows(made);
        return made;
    }();
    return table;
}

} // namespace gnomon::app
