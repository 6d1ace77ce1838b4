// Pages that are opened from a folder cannot read other pages: results of a search then come without their sentences.
DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY &&= location.protocol !== 'file:';
