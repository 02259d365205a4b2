import { h } from '../dom/element'; import type { View } from '../router';
export class NewCasePage implements View { title=''; element=h('div'); constructor(_: unknown) {} destroy(): void {} }
