#pragma once

#include "app/gui/properties/property_page.h"
#include "app/gui/document/editor.h"

// The pages of the Properties dock, each for one kind of selection.
namespace palpa::gui {

/// What decides which rows the page for the present selection has: while it stays the same, the
/// page stays and only its values change.
QString pageKey(const Editor& editor);

/// The page for the present selection.
PropertyPage* makePage(const Workspace& workspace);

// Each fills an empty page.
void addProjectRows(PropertyPage& page);    // project_rows.cpp: nothing selected
void addPrimitiveRows(PropertyPage& page);  // primitive_rows.cpp: of the shape, when it is known
void addPointRows(PropertyPage& page);      // point_rows.cpp
void addPatchRows(PropertyPage& page);      // patch_rows.cpp
void addEdgeRows(PropertyPage& page);       // edge_rows.cpp
void addSupportRows(PropertyPage& page);    // condition_rows.cpp
void addLoadRows(PropertyPage& page);
void addTouchRows(PropertyPage& page);

/// Rows for the parts of a region: fields, buttons that remove and add.
void addRegionRows(PropertyPage& page, PropertyPage::Get<modeling::Region> get,
                   PropertyPage::Set<modeling::Region> set);  // region_rows.cpp
/// What decides about those rows.
QString regionKey(const modeling::Region& region);

}  // namespace palpa::gui
