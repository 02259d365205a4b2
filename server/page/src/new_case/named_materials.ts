// The named materials that a case may name, and what one gives to the fields of the form.
import { create } from "@bufbuild/protobuf";
import { CaseSchema, MaterialSchema, type Case, type Material } from "../../gen/cellcrush/v1/case_pb";
import type { NamedMaterial } from "../../gen/cellcrush/v1/cases_service_pb";
import { readField } from "./fields";
import type { Choice } from "./words";

export const kNamed = "material.named";

/** Where a field without a text has its value from. */
export interface Given { text: string; by: string }

export class NamedMaterials {
  private plain: Material | undefined; // the material before one was picked

  /** Those of the daemon; none if it is older than they are. */
  constructor(private readonly all: NamedMaterial[]) {}

  get isEmpty(): boolean {
    return this.all.length === 0;
  }

  /** The choices of a case, which may name one that the daemon does not know; none without a list. */
  choicesOf(value: Case): Choice[] {
    const choices = this.all.map(({ name, title }) => ({ value: name, label: name, help: title }));
    const name = value.material?.named;
    if (!name || this.isEmpty || this.of(value)) return choices;
    return [...choices, { value: name, label: name, help: "This daemon does not know it." }];
  }

  /** The material that a case names. */
  of(value: Case): NamedMaterial | undefined {
    return this.all.find(({ name }) => name === value.material?.named);
  }

  /** What the material that a case names has at the path of a field. */
  givenAt(value: Case, path: string): Given | undefined {
    const named = this.of(value);
    const text = named && readField(create(CaseSchema, { material: named.material }), path);
    return text ? { text, by: named.name } : undefined;
  }

  /** Puts a name in place of all numbers of the material; without a name, the numbers from before the first pick. */
  pick(value: Case, named: string): void {
    const before = value.material ?? create(MaterialSchema);
    this.plain ??= before;
    value.material = named ? create(MaterialSchema) : this.plain;
    value.material.named = named;
    value.material.plane = before.plane; // of the model, not of the material
    if (!named) this.plain = undefined;
  }
}
