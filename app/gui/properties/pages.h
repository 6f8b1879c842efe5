#pragma once

#include "app/gui/document/editor.h"
#include "app/gui/properties/property_page.h"

// Pages of the Properties panel, one for each kind of selection.
namespace palpa::gui {

/// Identifies the rows of the page for the present selection. While the key is the same, the page
/// stays and only its values change.
QString pageKey(const Editor& editor);

/// The page for the present selection.
PropertyPage* makePage(const Workspace& workspace);

// Each function fills an empty page.
void addProjectRows(PropertyPage& page);    // project_rows.cpp: nothing selected
void addPrimitiveRows(PropertyPage& page);  // primitive_rows.cpp: if the shape is known
void addPointRows(PropertyPage& page);      // point_rows.cpp
void addPatchRows(PropertyPage& page);      // patch_rows.cpp
void addEdgeRows(PropertyPage& page);       // edge_rows.cpp
void addSupportRows(PropertyPage& page);    // condition_rows.cpp
void addTouchRows(PropertyPage& page);
void addMeasurementRows(PropertyPage& page);  // measurement_rows.cpp
void addLoadRows(PropertyPage& page);         // load_rows.cpp

/// Row with the name of the selected support, load or touch.
void addNameRow(PropertyPage& page);  // condition_rows.cpp

/// Rows for the parts of a region, with fields and buttons to remove and add.
void addRegionRows(PropertyPage& page, PropertyPage::Get<modeling::Region> get,
                   PropertyPage::Set<modeling::Region> set);  // region_rows.cpp
/// Identifies these rows.
QString regionKey(const modeling::Region& region);

}  // namespace palpa::gui
