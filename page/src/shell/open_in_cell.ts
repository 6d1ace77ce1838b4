// Hands a case to the workspace "Cell": its address holds the case, so this is a change of place.
import type { Sections } from '../api';
import { caseOf, queryOf } from '../cell/case';
import { goTo } from './place';

export const openInCell = (sections: Sections): void => goTo({ workspace: 'cell', query: queryOf(caseOf(sections)) });
